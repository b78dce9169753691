"""Water between hulls and in moonpools"""
