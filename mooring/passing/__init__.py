"""Forces on a moored ship while another ship passes: double bodies of panels, Wang (1975), Kriebel (2005)."""
