// The integrator family: its energy statement, constraints, orders and amplification, for s = 1, 2, 3 and several ρ∞.
//
// References: the statements of proof in the design notes (energy, constraints, triads: to round-off; orders 2s for
// ρ∞ = 1 and 2s − 1 otherwise; steady rotation exact), the linear oscillator's amplification factor
// R(z) = 1 + z bᵀ (I − z a_α)⁻¹ 1, and the motion of a free body.

#include "../scene.h"

#include <samara/time/integrator.h>
#include <samara/time/projection.h>

#include <gtest/gtest.h>

using namespace samara;

namespace
{
  const std::string two_bodies = R"(
subsection Bodies
  subsection a
    set Type = rigid body
    set Mass = 2
    set Position = 0.5, 0, 0
    set Centre of mass = 0.1, 0.05, -0.1
    set Inertia = 0.1, 0.2, 0.25, 0.01, 0.02, -0.01
    set Frames = pivot at 0 0 0, hinge at 1 0 0
  end
  subsection b
    set Type = rigid body
    set Mass = 1
    set Position = 1.5, 0, 0
    set Centre of mass = 0, 0.1, 0.1
    set Inertia = 0.1, 0.1, 0.15
  end
end
)";

  const std::string joints = R"(
subsection Joints
  subsection ball
    set Type = spherical
    set Body A = ground
    set Body B = a.pivot
  end
  subsection hinge
    set Type = revolute
    set Body A = a.hinge
    set Body B = b.centre
    set Position = 1, 0, 0
    set Axis = 0, 1, 1
    #use
  end
end
subsection Loads
  subsection weight
    set Type = gravity
  end
end
)";

  const std::string beam = R"(
subsection Sections
  subsection s
    set Type = engineering constants
    set EA = 1e6
    set GA2 = 1e6
    set GA3 = 1e6
    set GJ = 10
    set EI2 = 10
    set EI3 = 10
    set Mass = 1
    set I2 = 0.01
    set I3 = 0.01
  end
end
subsection Bodies
  subsection rod
    set Type = beam
    set Points = 0, 0, 0; 2, 0, 0
    set Elements = 2
    set Degree = 2
    set Section = s
  end
end
)";

  std::string
  with(std::string text, const std::string &mark, const std::string &by)
  {
    return text.replace(text.find(mark), mark.size(), by);
  }

  double
  energy(const System &system, const State &state)
  {
    const auto e     = system.energy(state);
    double     total = e.kinetic + e.strain;
    for (const auto &c : system.model.contributions)
      total += c->potential_energy(state.point());
    return total;
  }

  /** A start with every twist different, made to obey the constraints. */
  State
  moving(const System &system, const double speed)
  {
    State state = system.reference();
    for (unsigned int i = 6; i < state.y.size(); ++i)
      state.y[i] = speed * std::sin(1.3 * (i - 5));
    Projection(system).velocities(state);
    return state;
  }

  /** Thrown and turning as a rigid body, with some bending velocity. */
  State
  thrown(const System &system, const double spin, const double bending)
  {
    State state = system.reference();
    for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
      {
        const double x = system.model.nodes[node].x(0) - 1;
        Eigen::Map<Vector6>(&state.y[6 * node]) << 0.3, spin * x, bending * x * x, 0.2, 0, spin;
      }
    return state;
  }

  struct Record
  {
    State  state;
    double energy_error = 0; ///< largest of E_f − E_i − work + loss + D, relative to the energy at start
    double dissipated = 0, constraints = 0, triads = 0;
    bool   converged = true, decays = true;
  };

  Record
  run(const System &system, State state, const unsigned int s, const double rho, const double h, const unsigned int n_steps)
  {
    Integrator   integrator(system, Tableau(s, rho), 1e-14);
    Record          result;
    const double scale = system.energy(state).kinetic + system.energy(state).strain;
    for (unsigned int i = 0; i < n_steps; ++i)
      {
        const double before = energy(system, state);
        double       gravity = 0;
        for (const auto &c : system.model.contributions)
          gravity -= c->potential_energy(state.point());
        const StepResult step = integrator.step(state, h);
        if (!step.converged)
          {
            result.converged = false;
            break;
          }
        // gravity has a potential and is among the loads, too
        for (const auto &c : system.model.contributions)
          gravity += c->potential_energy(state.point());
        const double error = energy(system, state) - before - (step.work_of_loads + gravity) + step.viscous_loss +
                             step.dissipated - step.work_of_drives;
        result.energy_error = std::max(result.energy_error, std::abs(error) / scale);
        result.dissipated += step.dissipated;
        result.decays = result.decays && step.dissipated >= 0;
        std::vector<double> r(system.size() + 6, 0.);
        State               free = state;
        free.held                = false;
        for (const auto *c : system.layout.constraining)
          c->residual(free.point(), r.data());
        for (unsigned int k = 0; k < system.layout.n_multipliers; ++k)
          result.constraints = std::max(result.constraints, std::abs(r[system.layout.of_multiplier(k)]));
        for (unsigned int node = 1; node < system.layout.n_nodes; ++node)
          result.triads = std::max(
            result.triads,
            (state.triad(node).transpose() * state.triad(node) - Matrix3::Identity()).cwiseAbs().maxCoeff());
      }
    result.state = state;
    return result;
  }

  double
  distance(const State &a, const State &b)
  {
    return (Eigen::Map<const Eigen::VectorXd>(a.q.data(), a.q.size()) -
            Eigen::Map<const Eigen::VectorXd>(b.q.data(), b.q.size()))
      .norm();
  }
} // namespace



TEST(Tableau, DissipatesOnlyTheHighestLegendreMode)
{
  for (const unsigned int s : {1, 2, 3})
    for (const double rho : {0., 0.3, 1.})
      {
        const Tableau         t(s, rho);
        const Eigen::MatrixXd B = t.b.asDiagonal(), m = B * t.a_alpha + t.a_alpha.transpose() * B - t.b * t.b.transpose();
        const Eigen::VectorXd bp = t.b.cwiseProduct(t.p);
        EXPECT_LT((m - t.alpha / (2. * s - 1) * bp * bp.transpose()).norm(), 1e-15);
        // amplification at infinite frequency
        const std::complex<double> z(0, 1e8);
        const Eigen::MatrixXcd     A = Eigen::MatrixXcd::Identity(s, s) - z * t.a_alpha;
        const std::complex<double> R = 1. + z * t.b.cast<std::complex<double>>().dot(A.lu().solve(Eigen::VectorXcd::Ones(s)));
        EXPECT_NEAR(std::abs(R), rho, 1e-6);
      }
  EXPECT_THROW(Tableau(4, 1.), std::invalid_argument);
  EXPECT_THROW(Tableau(2, 1.5), std::invalid_argument);
}



TEST(Integrator, EnergyStatementOfJointedBodies)
{
  const std::string use = "subsection rotation\n set Spring = 3\n set Rest = 0.4\n set Damper = 0.2\n end\n";
  for (const std::string &motion : {std::string(), use})
    {
      Scene scene(two_bodies + with(joints, "#use", motion));
      const State start = moving(scene.system, 2.);
      for (const unsigned int s : {1, 2, 3})
        for (const double rho : {1., 0.5, 0.})
          for (const double h : {0.002, 0.02})
            {
              const Record r = run(scene.system, start, s, rho, h, 40);
              EXPECT_TRUE(r.converged) << "s = " << s << ", rho = " << rho << ", h = " << h;
              EXPECT_LT(r.energy_error, 2e-12) << "s = " << s << ", rho = " << rho << ", h = " << h;
              EXPECT_LT(r.constraints, 2e-12);
              EXPECT_LT(r.triads, 1e-13);
              EXPECT_TRUE(r.decays);
              EXPECT_EQ(r.dissipated > 0, rho < 1);
            }
    }
}



TEST(Integrator, OrdersOfJointedBodies)
{
  Scene       scene(two_bodies + with(joints, "#use", "subsection rotation\n set Spring = 3\n end\n"));
  const State start = moving(scene.system, 1.5), exact = run(scene.system, start, 3, 1., 0.0025, 80).state;
  for (const unsigned int s : {1, 2, 3})
    for (const double rho : {1., 0.5, 0.})
      {
        if (s == 1 && rho < 1)
          continue; // first order, for settling only
        const double       order = rho == 1. ? 2 * s : 2 * s - 1;
        const unsigned int n     = s == 1 ? 80 : s == 2 ? 20 : 5;
        const double       error = distance(run(scene.system, start, s, rho, 0.2 / n, n).state, exact),
                     finer       = distance(run(scene.system, start, s, rho, 0.1 / n, 2 * n).state, exact);
        EXPECT_NEAR(std::log2(error / finer), order, 0.25) << "s = " << s << ", rho = " << rho << ", error " << finer;
      }
}



TEST(Integrator, EnergyStatementOfAStiffFlyingBeam)
{
  Scene       scene(beam);
  const State start = thrown(scene.system, 3., 1.5);
  for (const unsigned int s : {1, 2, 3})
    for (const double rho : {1., 0.5, 0.})
      {
        const Record r = run(scene.system, start, s, rho, 0.01, 50);
        EXPECT_TRUE(r.converged) << "s = " << s << ", rho = " << rho;
        EXPECT_LT(r.energy_error, 1e-11) << "s = " << s << ", rho = " << rho;
        EXPECT_TRUE(r.decays);
      }
}



TEST(Integrator, SteadyRotationIsExact)
{
  Scene pinned(with(beam, "set Points = 0, 0, 0; 2, 0, 0", "set Points = 0.5, 0, 0; 2, 0, 0") + R"(
subsection Joints
  subsection clamp
    set Type = revolute
    set Body A = ground
    set Body B = rod.start
    set Position = 0, 0, 0
  end
end
subsection Loads
  subsection r
    set Type = steady rotation
    set Joint = clamp
    set Speed = 10
  end
end
)");
  const State start = pinned.equilibrium();
  for (const double rho : {1., 0.})
    {
      const Record r = run(pinned.system, start, 2, rho, 0.03, 40); // 0.3 rad a step
      ASSERT_TRUE(r.converged);
      EXPECT_LT(r.dissipated, 1e-8 * pinned.system.energy(start).kinetic); // the start is an equilibrium to 1e-9
      EXPECT_NEAR(energy(pinned.system, r.state) / energy(pinned.system, start), 1., 1e-8);
    }
}
