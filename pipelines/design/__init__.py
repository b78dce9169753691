"""`hakobune design`: a mooring in all load cases of a site, judged by rule sets, as one report.

project → databases of every water level → load cases, each a mooring study of its own → criteria → verdict → page
"""
