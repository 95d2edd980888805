// Bristles of pairs of groups in the stages of a step (doc/theory/contact.md).
//
// A pair that touches has bristles that are bent by z in its tangent plane. In the step z has two components, along
// axes that turn with A about the normal, and with the normal by the least turn: the slips have the same, so that the
// work of the step is exact as for single contacts, whatever the axes do. What touches anew is straight; what has
// parted at the end of a step is straightened, and its energy is lost.

#include <samara/time/stage_bristles.h>
#include <samara/time/stage_contacts.h>

#include <cmath>

namespace samara
{
  namespace
  {
    using TangentAxes = Eigen::Matrix<double, 3, 2>;

    /** Any two axes of the plane with this normal. */
    TangentAxes
    axes_of_plane(const Vector3 &normal)
    {
      int least = 0;
      normal.cwiseAbs().minCoeff(&least);
      TangentAxes axes;
      axes.col(0) = normal.cross(Vector3(Vector3::Unit(least))).normalized();
      axes.col(1) = normal.cross(Vector3(axes.col(0)));
      return axes;
    }



    /** The axes nearest to these in the plane with this normal: those that are turned by the least angle. False if
     * that is nearly a right one. */
    bool
    lay_into_plane(const Vector3 &normal, TangentAxes &axes)
    {
      constexpr double least = 1e-2; // cosine of the angle
      axes -= normal * (normal.transpose() * axes);
      // T (TᵀT)^(−½), by the root of a 2 × 2 matrix: √S = (S + √det)/√(tr + 2 √det)
      const Eigen::Matrix2d S    = axes.transpose() * axes;
      const double          root = std::sqrt(std::max(S.determinant(), 0.));
      if (!(root > least))
        return false;
      const Eigen::Matrix2d sqrt_S = (S + root * Eigen::Matrix2d::Identity()) / std::sqrt(S.trace() + 2 * root);
      axes *= sqrt_S.inverse();
      return true;
    }
  } // namespace



  void
  StageContacts::start_bristles(const State &state, Near &n, const PairMeasure<double> &m)
  {
    Bristles b;
    b.normal                 = m.normal;
    b.node                   = sides.a.front().frame.node;
    const PairBristle *known = n.gap > 0 ? n.group->find_bristle(n.pair, state.bristles) : nullptr;
    b.start                  = known != nullptr ? known->deflection : Vector3(Vector3::Zero());
    b.stages.fill(b.start);
    n.bristles = bristles.size();
    bristles.push_back(b);
  }



  void
  StageContacts::find_lost_bristles(const State &state)
  {
    lost_at_start = 0;
    if (state.bristles.empty())
      return;
    for (const ContactGroup *const group : system.layout.contact_groups)
      lost_at_start += group->energy_of(state.bristles);
    for (const Near &n : near)
      if (n.bristles >= 0)
        lost_at_start -= n.group->energy_of(n.group->bristle_of(n.pair, bristles[n.bristles].start));
    constexpr double round_off = 1e-12;
    if (lost_at_start < round_off)
      lost_at_start = 0;
  }



  void
  StageContacts::straighten(const Near &n)
  {
    // where nothing touches in the whole step
    Bristles &b      = bristles[n.bristles];
    b.elastic        = -n.group->energy_of(n.group->bristle_of(n.pair, b.start));
    b.loss           = -b.elastic;
    b.dissipated     = 0;
    b.end            = Vector3::Zero();
    b.touches_at_end = b.is_lost = false;
    b.stages.fill(Vector3::Zero());
  }



  void
  StageContacts::rub(const Near                       &n,
                     const std::vector<Point<double>> &stages,
                     const double *const               end,
                     const PairMeasure<double>        &at_end,
                     const double                      h,
                     std::array<Vec3<double>, 3>      &rub)
  {
    const unsigned int s         = tableau.s;
    Bristles          &b         = bristles[n.bristles];
    const TangentAxes  at_start  = axes_of_plane(b.normal);
    const Matrix3      back      = Frame{b.node}.triad(q_start.data()).transpose();
    const auto         turned_to = [&](const double *const q, const Vector3 &normal) {
      TangentAxes axes = Frame{b.node}.triad(q) * back * at_start;
      b.is_lost        = !lay_into_plane(normal, axes) || b.is_lost;
      return axes;
    };
    FrictionLaw  law   = n.group->bodies_of(n.pair).friction;
    const double share = n.group->share_of(n.pair), part = n.group->part_of(n.pair);
    law.bristle_stiffness *= share;
    law.bristle_damping *= share;

    std::array<TangentAxes, 3> axes;
    std::array<double, 3>      normal{};
    Eigen::VectorXd            slips(2 * s);
    for (unsigned int k = 0; k < s; ++k)
      {
        const PairMeasure<double> &m = measures_of_stages[k];
        axes[k]                      = turned_to(stages[k].q, m.normal);
        normal[k]                    = std::max(0., part * n.forces.force[k]);
        const Eigen::Vector2d w      = axes[k].transpose() * m.slip;
        slips(k)                     = w(0);
        slips(s + k)                 = w(1);
      }
    const TangentAxes axes_at_end = turned_to(end, at_end.normal);
    if (b.is_lost)
      {
        rub.fill(Vec3<double>::Zero());
        return;
      }
    const Eigen::VectorXd start = at_start.transpose() * b.start;
    const BristleForces   f     = bristle_forces(law, tableau, start, slips, normal.data(), h, false);
    Eigen::Vector2d       z     = start;
    for (unsigned int k = 0; k < s; ++k)
      {
        rub[k]      = axes[k] * Eigen::Vector2d(f.force(k), f.force(s + k));
        b.stages[k] = axes[k] * Eigen::Vector2d(f.deflection(k), f.deflection(s + k));
        z += h * tableau.b(k) * Eigen::Vector2d(f.rate(k), f.rate(s + k));
      }
    b.touches_at_end    = at_end.gap > 0;
    b.end               = b.touches_at_end ? Vector3(axes_at_end * z) : Vector3(Vector3::Zero());
    const double wasted = b.touches_at_end ? 0. : 0.5 * law.bristle_stiffness * z.squaredNorm();
    b.elastic           = f.elastic - wasted;
    b.loss              = f.loss + wasted;
    b.dissipated        = f.dissipated;
  }



  void
  StageContacts::finish(State &state) const
  {
    state.bristles.clear();
    for (const Near &n : near)
      if (n.bristles >= 0 && bristles[n.bristles].touches_at_end)
        state.bristles.push_back(n.group->bristle_of(n.pair, bristles[n.bristles].end));
  }
} // namespace samara
