"""What a mooring has to keep: rules as data, strength of chain and rope, fatigue, and the verdict on a result.

rules      criteria of rule sets, from tables beside the modules or from a file of the user's own in the same form
verdict    utilisation of each criterion by the results of load cases, and which case governs
strength   sizing by a safety factor, wear, equipment number
failing    the mark of a line that tells of what breaks, or fails what was asked
overuse    lines that part, or use more of their breaking load than is allowable
fatigue    cycles of a tension record or of its spectrum, curves of strength, Miner's sum
"""
