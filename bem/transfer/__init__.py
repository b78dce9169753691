"""Many bodies far from each other: one shape's answers to partial waves, coupled by what each sends (Kagemoto & Yue)."""
