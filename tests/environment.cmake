# The environment of every test, read by ctest itself: one thread each.
set(ENV{OPENBLAS_NUM_THREADS} 1)
set(ENV{OMP_NUM_THREADS} 1)
set(ENV{DEAL_II_NUM_THREADS} 1)
