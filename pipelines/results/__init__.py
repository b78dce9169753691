"""What a study found, as data: quantities with name, unit, axes and full precision, from which every view follows."""
