"""Results of studies as data: quantities with name, unit, axes and full precision, from which every view is made."""
