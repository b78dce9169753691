"""Mooring lines in detail: static lines of many parts, their dynamics, and the loads on them.

A dynamic line in the loop of a simulation: `dynamics.driven.DrivenLine(line, current, waves, tolerance)` with
`rest(fairlead) → State` and `advance(state, step, position, velocity) → State, Pull`.
"""
