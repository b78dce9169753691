"""`hakobune response`: a floating body in a sea or a climate."""
