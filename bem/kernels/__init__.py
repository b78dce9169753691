"""Infrastructure of the methods: compiled kernels, threads, SIMD vectors, and reports of progress."""
