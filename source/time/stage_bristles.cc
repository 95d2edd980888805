#include <samara/time/stage_bristles.h>

#include <samara/base/dense.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Bristles that slip at less than this [m] are pressed by nothing. */
    constexpr double least_deflection = 1e-20;



    /** What the slip and the normal force of one stage make of the law. */
    struct BristleStage
    {
      bool   presses = false;
      double size    = 0;        ///< |w|
      double r = 0, damping = 0; ///< σ₀|w|/G, σ₁(w)
      double r_by_normal = 0, damping_by_normal = 0;
      double r_by_slip = 0, damping_by_slip = 0; ///< times w: derivatives by the slips

      BristleStage(const FrictionLaw &law, const double square, const double normal)
        : size(std::sqrt(square))
      {
        const auto   mu      = law.coefficient(square);
        const double G       = normal * mu.c;
        const double sigma_0 = law.bristle_stiffness, sigma_1 = law.bristle_damping;
        presses = G > least_deflection * sigma_0;
        if (!presses)
          return;
        const double G_by_slip = 2 * normal * mu.slope, root = 4 * G + sigma_1 * size;
        r                 = sigma_0 * size / G;
        r_by_normal       = -r / normal;
        damping           = 4 * sigma_1 * G / root;
        damping_by_normal = 4 * std::pow(sigma_1 / root, 2) * size * mu.c;
        // |w| has no derivative at zero; there bristles are elastic
        r_by_slip       = (size > 0 ? sigma_0 / (G * size) : 0.) - r / G * G_by_slip;
        damping_by_slip = 4 * std::pow(sigma_1 / root, 2) * (size * G_by_slip - (size > 0 ? G / size : 0.));
      }
    };



    /** Bristles that nothing presses: they straighten. */
    void
    straighten(const Tableau &t, const Eigen::Ref<const Eigen::VectorXd> &start, const double h, BristleForces &f)
    {
      for (unsigned int i = 0; i < start.size(); ++i)
        for (unsigned int k = 0; k < t.s; ++k)
          {
            f.rate(t.s * i + k)       = -start(i) / h;
            f.deflection(t.s * i + k) = start(i) * (1 - t.a_alpha.row(k).sum());
          }
    }



    void
    account_for_bristles(const FrictionLaw                       &law,
                         const Tableau                           &t,
                         const Eigen::Ref<const Eigen::VectorXd> &start,
                         const Eigen::Ref<const Eigen::VectorXd> &slips,
                         const double                             h,
                         BristleForces                           &f)
    {
      for (unsigned int i = 0; i < start.size(); ++i)
        {
          double way = 0, mode = 0;
          for (unsigned int k = 0; k < t.s; ++k)
            {
              const unsigned int j = t.s * i + k;
              f.loss += h * t.b(k) * (f.force(j) * slips(j) - law.bristle_stiffness * f.deflection(j) * f.rate(j));
              way += h * t.b(k) * f.rate(j);
              mode += h * t.b(k) * t.p(k) * f.rate(j);
            }
          f.elastic += law.bristle_stiffness * way * (start(i) + 0.5 * way);
          f.dissipated += law.bristle_stiffness * t.alpha / (2 * (2. * t.s - 1)) * mode * mode;
        }
    }



    using VectorRef = Eigen::Ref<const Eigen::VectorXd>;

    std::vector<BristleStage>
    stages_of(const FrictionLaw &law, const unsigned int s, const VectorRef &slips, const double *normal)
    {
      std::vector<BristleStage> stages;
      for (unsigned int k = 0; k < s; ++k)
        {
          double square = 0;
          for (unsigned int i = k; i < slips.size(); i += s)
            square += slips(i) * slips(i);
          stages.emplace_back(law, square, normal[k]);
        }
      return stages;
    }



    /** Of (w/h + r) z = slip + w z_start / h for one bristle at all stages: ∂z/∂(right side), 0 where nothing presses.
     */
    Eigen::MatrixXd
    deflection_by_slip(const std::vector<BristleStage> &stages, const Eigen::MatrixXd &W, const double h)
    {
      // rows are divided by their diagonal: bristles that slip have a large one
      const unsigned int s = stages.size();
      Eigen::MatrixXd    M = Eigen::MatrixXd::Identity(s, s);
      Eigen::VectorXd    scale(s);
      for (unsigned int k = 0; k < s; ++k)
        {
          scale(k) = stages[k].presses ? 1 / (1 / h + stages[k].r) : 0.;
          if (stages[k].presses)
            {
              M.row(k) = scale(k) * W.row(k);
              M(k, k) += scale(k) * stages[k].r;
            }
        }
      return inverse(M) * scale.asDiagonal();
    }



    /** Deflections z, their rates and forces σ₀ z + σ₁ ż of bristles that are pressed in some stage. */
    void
    deflect(const FrictionLaw               &law,
            const std::vector<BristleStage> &stages,
            const Eigen::MatrixXd           &W,
            const Eigen::MatrixXd           &inverse,
            const VectorRef                 &start,
            const VectorRef                 &slips,
            BristleForces                   &f)
    {
      const unsigned int s = stages.size();
      for (unsigned int i = 0; i < start.size(); ++i)
        {
          const auto z                   = f.deflection.segment(s * i, s);
          const auto zd                  = f.rate.segment(s * i, s);
          f.deflection.segment(s * i, s) = inverse * (slips.segment(s * i, s) + start(i) * W.rowwise().sum());
          f.rate.segment(s * i, s)       = W * (z.array() - start(i)).matrix();
          for (unsigned int k = 0; k < s; ++k)
            if (stages[k].presses)
              f.force(s * i + k) = law.bristle_stiffness * z(k) + stages[k].damping * zd(k);
            else
              f.deflection(s * i + k) = 0; // it is, but for round-off
        }
    }



    /** δz = M⁻¹ (δw − z δr), δż = W δz, δf = σ₀ δz + σ₁ δż + ż δσ₁. */
    void
    add_slopes(const FrictionLaw               &law,
               const std::vector<BristleStage> &stages,
               const Eigen::MatrixXd           &W,
               const Eigen::MatrixXd           &inverse,
               const VectorRef                 &slips,
               BristleForces                   &f)
    {
      const unsigned int s = stages.size(), n = slips.size() / s;
      for (unsigned int l = 0; l < s; ++l)
        {
          if (!stages[l].presses)
            continue;
          const Eigen::VectorXd dz = inverse.col(l), dzd = W * dz;
          for (unsigned int i = 0; i < n; ++i)
            {
              const double z_l = f.deflection(s * i + l), zd_l = f.rate(s * i + l);
              for (unsigned int k = 0; k < s; ++k)
                {
                  if (!stages[k].presses)
                    continue;
                  const double by_right = law.bristle_stiffness * dz(k) + stages[k].damping * dzd(k);
                  f.by_slip(s * i + k, s * i + l) += by_right;
                  f.by_normal(s * i + k, l) -= by_right * z_l * stages[l].r_by_normal;
                  for (unsigned int j = 0; j < n; ++j)
                    f.by_slip(s * i + k, s * j + l) -= by_right * z_l * stages[l].r_by_slip * slips(s * j + l);
                }
              f.by_normal(s * i + l, l) += zd_l * stages[l].damping_by_normal;
              for (unsigned int j = 0; j < n; ++j)
                f.by_slip(s * i + l, s * j + l) += zd_l * stages[l].damping_by_slip * slips(s * j + l);
            }
        }
    }
  } // namespace



  BristleForces
  bristle_forces(const FrictionLaw                       &law,
                 const Tableau                           &t,
                 const Eigen::Ref<const Eigen::VectorXd> &start,
                 const Eigen::Ref<const Eigen::VectorXd> &slips,
                 const double                            *normal,
                 const double                             h,
                 const bool                               with_slopes)
  {
    const unsigned int s = t.s, n = start.size();
    Assert(slips.size() == s * n, dealii::ExcDimensionMismatch(slips.size(), s * n));
    BristleForces f;
    f.deflection.setZero(s * n);
    f.rate.setZero(s * n);
    f.force.setZero(s * n);
    if (with_slopes)
      {
        f.by_slip.setZero(s * n, s * n);
        f.by_normal.setZero(s * n, s);
      }
    const auto stages = stages_of(law, s, slips, normal);
    if (std::none_of(stages.begin(), stages.end(), [](const BristleStage &stage) { return stage.presses; }))
      {
        straighten(t, start, h, f);
        account_for_bristles(law, t, start, slips, h, f);
        return f;
      }
    const Eigen::MatrixXd W = t.w / h, inverse = deflection_by_slip(stages, W, h);
    deflect(law, stages, W, inverse, start, slips, f);
    account_for_bristles(law, t, start, slips, h, f);
    if (with_slopes)
      add_slopes(law, stages, W, inverse, slips, f);
    return f;
  }
} // namespace samara
