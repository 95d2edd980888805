# The environment of every test, read by ctest itself: one thread each, and no complaint of MPI about root or a missing ssh.
set(ENV{OPENBLAS_NUM_THREADS} 1)
set(ENV{OMP_NUM_THREADS} 1)
set(ENV{DEAL_II_NUM_THREADS} 1)
set(ENV{OMPI_ALLOW_RUN_AS_ROOT} 1)
set(ENV{OMPI_ALLOW_RUN_AS_ROOT_CONFIRM} 1)
set(ENV{OMPI_MCA_plm_rsh_agent} true)
