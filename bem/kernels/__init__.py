"""Infrastructure of the methods: compiled kernels, threads, SIMD vectors, progress."""
