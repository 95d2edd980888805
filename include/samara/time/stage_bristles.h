#ifndef samara_time_stage_bristles_h
#define samara_time_stage_bristles_h

#include <samara/base/friction_law.h>
#include <samara/time/tableau.h>

namespace samara
{
  /**
   * Bristles (FrictionLaw) in all stages of a step. Their deflections are states on the dissipative tableau, but no
   * unknowns: with the slips w_k and normal forces N_k of the stages their equations are linear in them,
   *
   *     Σ_l w_kl (z_l − z_i)/h + σ₀ |w_k|/G_k z_k = w_k          z_k = 0 where G_k = 0
   *
   * Where nothing presses in any stage, ż_k = −z_i/h: bristles that are free straighten within the step, and their
   * energy is lost.
   *
   *     h Σ b f·w = ½ σ₀ (|z_f|² − |z_i|²) + loss + dissipated
   *
   * with loss = h Σ b (f·w − σ₀ z·ż) and the numerical dissipation of the tableau, both not negative.
   *
   * Numbers of a slip i in stage k stand at s i + k; derivatives in the columns of what they are by.
   */
  struct BristleForces
  {
    Eigen::VectorXd deflection, rate;                      ///< z [m], ż [m/s]
    Eigen::VectorXd force;                                 ///< f against growing slips [N]
    Eigen::MatrixXd by_slip;                               ///< ∂f/∂w, where wanted
    Eigen::MatrixXd by_normal;                             ///< ∂f/∂N, a column for each stage
    double          loss = 0, elastic = 0, dissipated = 0; ///< [J]; elastic: change of ½ σ₀ |z|²
  };

  /**
   * @param start z_i of each slip [m]; @param slips w [m/s]; @param normal N_k ≥ 0 of the stages [N]; @param h the step
   * [s].
   */
  BristleForces bristle_forces(const FrictionLaw                       &law,
                               const Tableau                           &tableau,
                               const Eigen::Ref<const Eigen::VectorXd> &start,
                               const Eigen::Ref<const Eigen::VectorXd> &slips,
                               const double                            *normal,
                               double                                   h,
                               bool                                     with_slopes);
} // namespace samara

#endif
