"""What every kernel is compiled, threaded and vectorised by, and dense linear algebra that more than one method
uses.
"""
