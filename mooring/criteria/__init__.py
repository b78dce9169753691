"""Requirements on a mooring: rule sets as data, strength of chain and rope, fatigue, and the verdict on a result.

rules      criteria of rule sets, from tables beside the modules or from a user's file in the same form
verdict    utilisation of each criterion by the results of load cases, and the governing case
strength   sizing by a safety factor, wear, equipment number
failing    the mark of a finding on something that breaks or fails a requirement
overuse    lines that part, or exceed their allowable share of the breaking load
fatigue    cycles of a tension record or of its spectrum, S-N curves, Miner's sum
"""
