"""Floating bodies between dolphins with fenders: design calculations that need no simulation.

linearised       equivalent stiffness and damping of a fender, amplitude by amplitude; exact periods of free motion
design_spectrum  strain of fenders by the design spectrum method, limit wave height
earthquake       ground motion at the roots of the dolphins
"""
