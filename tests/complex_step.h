#include <samara/analysis/complex_step.h>
