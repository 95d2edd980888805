#ifndef samara_analysis_finite_matrix_h
#define samara_analysis_finite_matrix_h

#include <samara/model/system.h>

namespace samara
{
  /** Of a matrix, such as the tangent at infinite loads: @throws NotConverged naming an unknown that is not finite. */
  void require_finite_matrix(const System &system, const SparseMatrix &A);
} // namespace samara

#endif
