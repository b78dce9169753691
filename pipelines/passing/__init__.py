"""`hakobune passing`: forces on a moored ship while another ship passes."""
