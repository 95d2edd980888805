// The matrix of all stages against differences of their equations, which are written down here once more. With K ζ_α
// in place of stresses from the rates of strains it was wrong by 4e-3 of the stiffness at .4 radian a step, and
// Newton's method gained one digit an iteration.

#include <samara/time/exact_stages.h>

#include "systems.h"

using namespace samara;

namespace
{
  using Vectors = std::vector<std::vector<double>>;

  /** The stages of a step of a model without loads and states that are moved by twists, and their residuals. */
  class Stages
  {
  public:
    Stages(const System &system, const State &start, const Tableau &tableau, const double h)
      : system(system)
      , start(start)
      , t(tableau)
      , h(h)
    {}

    /** Residuals and constraint rates; @p x: twists, rates of coordinates and multipliers of all stages. */
    Vectors
    residuals(const Vectors &x)
    {
      const Layout &layout = system.layout;
      move(x);
      Vectors             result(t.s, std::vector<double>(system.size() + 6, 0.)), rates(t.s);
      std::vector<double> e_start(layout.n_strains);
      system.strains(start.point(), e_start.data());
      for (unsigned int k = 0; k < t.s; ++k)
        {
          rates[k].resize(layout.n_strains);
          system.strain_rates(point(k), rates[k].data());
        }
      for (unsigned int k = 0; k < t.s; ++k)
        {
          std::vector<double> e = e_start;
          for (unsigned int l = 0; l < t.s; ++l)
            for (unsigned int i = 0; i < e.size(); ++i)
              e[i] += h * t.a_alpha(k, l) * rates[l][i];
          stress[k].resize(e.size());
          system.stresses(e.data(), rates[k].data(), stress[k].data());
          system.add_bonds(point(k), result[k].data());
          for (unsigned int node = 1; node < layout.n_nodes; ++node)
            {
              const Matrix6 &M = system.model.nodes[node].inertia;
              const auto     y = [&](const std::vector<double> &of) {
                return Vector6(Eigen::Map<const Vector6>(&of[6 * node]));
              };
              Vector6 r = -ad_star<double>(y(twists[k]), M * y(twists[k]));
              for (unsigned int l = 0; l < t.s; ++l)
                r += t.w(k, l) / h * (M * (y(twists[l]) - y(start.y)));
              Eigen::Map<Vector6>(&result[k][layout.of_node(node)]) += r;
            }
          system.constraint_rates(point(k), &result[k][layout.of_multiplier(0)]);
        }
      return result;
    }

    Point<double>
    point(const unsigned int k) const
    {
      Point<double> p = start.point();
      p.q             = q[k].data();
      p.coordinates   = coordinates[k].data();
      p.y             = twists[k].data();
      p.rates         = coordinate_rates[k].data();
      p.multipliers   = multipliers[k].data();
      p.stress        = stress[k].data();
      p.held          = false;
      return p;
    }

  private:
    const System &system;
    const State  &start;
    const Tableau t;
    const double  h;
    Vectors       q = Vectors(3), coordinates = Vectors(3), twists = Vectors(3), coordinate_rates = Vectors(3),
            multipliers = Vectors(3), stress = Vectors(3);

    /** q_k = q_i + h Σ a_kl N(q_l) y_l, by passes that gain the turn of a step each. */
    void
    move(const Vectors &x)
    {
      const Layout &layout = system.layout;
      for (unsigned int k = 0; k < t.s; ++k)
        {
          q[k] = start.q;
          twists[k].assign(6, 0.);
          twists[k].insert(twists[k].end(), x[k].begin(), x[k].begin() + layout.of_coordinate(0));
          coordinate_rates[k].assign(x[k].begin() + layout.of_coordinate(0), x[k].begin() + layout.of_state(0));
          multipliers[k].assign(x[k].begin() + layout.of_multiplier(0), x[k].begin() + system.size());
          stress[k].resize(layout.n_strains);
        }
      for (unsigned int pass = 0; pass < 60; ++pass)
        {
          const Vectors before = q;
          for (unsigned int k = 0; k < t.s; ++k)
            {
              q[k] = start.q;
              for (unsigned int l = 0; l < t.s; ++l)
                for (unsigned int node = 1; node < layout.n_nodes; ++node)
                  {
                    const Eigen::Map<const Matrix3> D(&before[l][12 * node + 3]);
                    const double *const             y = &twists[l][6 * node];
                    Eigen::Map<Vector3>(&q[k][12 * node]) += h * t.a(k, l) * D * Eigen::Map<const Vector3>(y);
                    Eigen::Map<Matrix3>(&q[k][12 * node + 3]) +=
                      h * t.a(k, l) * D * skew(Vector3(Eigen::Map<const Vector3>(y + 3)));
                  }
            }
        }
      for (unsigned int k = 0; k < t.s; ++k)
        {
          coordinates[k] = start.coordinates;
          for (unsigned int l = 0; l < t.s; ++l)
            for (unsigned int i = 0; i < coordinates[k].size(); ++i)
              coordinates[k][i] += h * t.a(k, l) * coordinate_rates[l][i];
        }
    }
  };
} // namespace



namespace
{
  /** A light screw on a beam, which is what the matrix without Ḃ was worst at. */
  const std::string screw_on_beam =
    "subsection Sections\n subsection s\n set Type = engineering constants\n set EA = 2e4\n set GA2 = 8e3\n"
    " set GA3 = 7e3\n set GJ = 30\n set EI2 = 40\n set EI3 = 50\n set Mass = 0.5\n set I2 = 1e-3\n"
    " set I3 = 2e-3\n end\nend\n"
    "subsection Bodies\n subsection rod\n set Type = beam\n set Points = 0, 0, 0; 1, 0.2, 0\n set Section = s\n"
    " set Elements = 2\n set Degree = 2\n set Damping = 2e-3\n end\n"
    " subsection nut\n set Type = rigid body\n set Mass = 0.2\n set Inertia = 1e-3, 2e-3, 1.5e-3\n"
    " set Position = 1, 0.2, 0\n end\nend\n"
    "subsection Joints\n subsection root\n set Type = revolute\n set Body A = ground\n set Body B = rod.start\n"
    " set Axis = 0, 0.3, 1\n subsection rotation\n set Spring = 20\n set Damper = 0.1\n end\n end\n"
    " subsection tip\n set Type = screw\n set Body A = rod.end\n set Body B = nut.centre\n set Axis = 1, 0, 0.2\n"
    " set Pitch = 0.02\n subsection rotation\n set Spring = 5\n end\n end\nend\n";

  /** Largest error of the solution for a right side that is known, in a step @p h of any motion. */
  double
  error_of_solution(const System &system, const Tableau &tableau, const double h)
  {
    const State        state = system.reference();
    Stages             stages(system, state, tableau, h);
    const unsigned int s = tableau.s, n                = system.size();
    Vectors            x(s, std::vector<double>(n)), d = x;
    for (unsigned int k = 0; k < s; ++k)
      for (unsigned int i = 0; i < n; ++i)
        {
          x[k][i] = 8 * std::sin(1. + 5. * i + 0.3 * k * h);
          d[k][i] = std::sin(2. + 3. * i + 7. * k);
        }
    const auto moved = [&](const double step) {
      Vectors result = x;
      for (unsigned int k = 0; k < s; ++k)
        for (unsigned int i = 0; i < n; ++i)
          result[k][i] += step * d[k][i];
      return stages.residuals(result);
    };
    constexpr double step  = 1e-3;
    const Vectors    ahead = moved(step), behind = moved(-step), far = moved(2 * step), back = moved(-2 * step);
    Vectors          right(s, std::vector<double>(n));
    for (unsigned int k = 0; k < s; ++k)
      for (unsigned int i = 0; i < n; ++i)
        right[k][i] = (8 * (ahead[k][i] - behind[k][i]) - (far[k][i] - back[k][i])) / (12 * step);
    moved(0);
    ExactStages                exact(system, tableau);
    std::vector<Point<double>> points;
    for (unsigned int k = 0; k < s; ++k)
      points.push_back(stages.point(k));
    exact.assemble(points, h, std::vector<bool>(system.layout.n_multipliers, true));
    exact.solve(right);
    double error = 0;
    for (unsigned int k = 0; k < s; ++k)
      for (unsigned int i = 0; i < n; ++i)
        if (i < static_cast<unsigned int>(system.layout.of_multiplier(0)))
          error = std::max(error, std::abs(right[k][i] + d[k][i]));
    return error;
  }
} // namespace



// What is left is that stages are not orthonormal, O(h^{s+1}). Without Ḃ it was O(h) with any number of stages.
TEST(ExactStages, AreTheDerivativeOfTheEquations)
{
  const Scene scene(screw_on_beam);
  for (const unsigned int s : {1, 2, 3})
    for (const double rho : {1., 0.3})
      {
        const Tableau tableau(s, rho);
        const double  h = s == 3 ? 0.02 : 0.01, error = error_of_solution(scene.system, tableau, h),
                     finer = error_of_solution(scene.system, tableau, h / 2);
        EXPECT_GT(std::log2(error / finer), s + 0.9) << s << ", " << rho << ", " << error;
      }
}
