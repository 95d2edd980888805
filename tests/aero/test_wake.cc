// Vortex lines and the helical wake: closed forms, momentum theory, derivatives, hover against Peters and He.

#include <samara/aero/helical_wake.h>
#include <samara/solvers/swept_solver.h>
#include <samara/time/stage_integrator.h>

#include "../complex_step.h"
#include "../scene.h"
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"

using namespace samara;
using namespace samara::aero_models;

namespace
{
  VortexLine<double>
  ring(const double radius, const unsigned int n)
  {
    VortexLine<double> line;
    line.resize(n + 1);
    for (unsigned int i = 0; i <= n; ++i)
      {
        line.x[i] = radius * std::cos(2 * M_PI * i / n);
        line.y[i] = radius * std::sin(2 * M_PI * i / n);
        line.z[i] = 0;
      }
    return line;
  }

  const HelicalWake &
  wake_of(const Scene &scene)
  {
    for (const auto &item : scene.input.model.items)
      if (const auto *const wake = dynamic_cast<const HelicalWake *>(item.get()))
        return *wake;
    throw std::logic_error("no wake");
  }
} // namespace



// H. Lamb, Hydrodynamics, art. 161: with complete elliptic integrals; polygons of n sides converge with n².
TEST(VortexLine, Ring)
{
  const double R = 2, core = 1e-9;
  const auto   error = [&](const unsigned int n) {
    double largest = 0;
    for (const auto &[r, z] : {std::pair<double, double>{0.5, 0.3}, {1.2, -0.7}, {2.5, 0.4}, {3.1, 0.}})
      {
        const double s = std::hypot(R + r, z), d = (R - r) * (R - r) + z * z, k = std::sqrt(4 * R * r) / s,
                     K = std::comp_ellint_1(k), E = std::comp_ellint_2(k);
        const double axial  = (K + (R * R - r * r - z * z) / d * E) / (2 * M_PI * s),
                     radial = z / (2 * M_PI * r * s) * (-K + (R * R + r * r + z * z) / d * E);
        const Vector3 v     = induced_velocity<double>(Vector3(0.6 * r, 0.8 * r, z), ring(R, n), core);
        largest =
          std::max({largest, std::abs(v(2) - axial), std::abs(v(0) - 0.6 * radial), std::abs(v(1) - 0.8 * radial)});
      }
    return largest;
  };
  EXPECT_LT(error(1600), 1e-6);
  EXPECT_NEAR(std::log2(error(400) / error(800)), 2., 0.05);
}



// A straight line with the core of Vatistas: h/(2π √(h⁴ + r_c⁴)); nothing on the line itself.
TEST(VortexLine, Core)
{
  VortexLine<double> line;
  line.x = {0, 0, 0, 0};
  line.y = {0, 0, 0, 0};
  line.z = {-1e4, -1, 2, 1e4};
  for (const double h : {0.01, 0.3, 2.})
    EXPECT_NEAR(induced_velocity<double>(Vector3(h, 0, 0.1), line, 0.5)(1),
                h / (2 * M_PI * std::sqrt(h * h * h * h + 0.0625)),
                1e-6);
  EXPECT_EQ(induced_velocity<double>(Vector3(0, 0, 2), line, 0.5).norm(), 0.);
}



// Four segments at once are the same as one after the other: also the few that are left over, places on the line and
// derivatives.
TEST(VortexLine, FourAtOnce)
{
  using Complex          = std::complex<double>;
  const auto largest_gap = [](const auto &line, const auto &at, const double core) {
    using Number                              = std::decay_t<decltype(at(0))>;
    const Eigen::Matrix<Number, 3, 1> at_once = induced_velocity<Number>(at, line, core);
    std::array<Number, 3>             one     = {Number(0), Number(0), Number(0)};
    internal::add_segments(at, line, 0, internal::VortexCore(core), one);
    double gap = 0;
    for (unsigned int i = 0; i < 3; ++i)
      gap = std::max(gap, std::abs(at_once(i) - one[i] / (4 * M_PI)));
    return gap;
  };
  const Vector3 way(1, 0, -2);
  for (const unsigned int n : {0, 1, 2, 4, 5, 8, 9, 11, 50})
    {
      VortexLine<double>  line;
      VortexLine<Complex> shaken;
      line.resize(n);
      shaken.resize(n);
      for (unsigned int i = 0; i < n; ++i)
        {
          line.x[i]   = 2 * std::cos(0.3 * i);
          line.y[i]   = 2 * std::sin(0.3 * i);
          line.z[i]   = -0.05 * i;
          shaken.x[i] = {line.x[i], std::sin(7. * i)};
          shaken.y[i] = {line.y[i], std::sin(5. * i)};
          shaken.z[i] = {line.z[i], std::sin(3. * i)};
        }
      std::vector<Vector3> places = {{1, 0.5, -0.3}, {2.01, 0.01, 0}, {30, -50, 10}};
      if (n > 2)
        places.emplace_back(line.x[2], line.y[2], line.z[2]);
      for (const Vector3 &at : places)
        {
          EXPECT_LT(largest_gap(line, at, 0.1), 1e-14) << n;
          EXPECT_LT(largest_gap(line, at, 1e-6), 1e-13) << n;
          // imaginary parts as small as those of derivatives, and, far from the line, larger ones
          for (const double size : {1e-30, at.norm() > 10 ? 0.3 : 1e-20})
            {
              VortexLine<Complex> to = shaken;
              for (auto *const x : {&to.x, &to.y, &to.z})
                for (auto &value : *x)
                  value.imag(size * value.imag());
              EXPECT_LT(largest_gap(to, Eigen::Vector3cd(at + Complex(0, size) * way), 0.1), 1e-13) << n << " " << size;
            }
        }
      // the derivative is that of doubles
      const double step = 1e-30, h = 1e-5;
      for (auto *const x : {&shaken.x, &shaken.y, &shaken.z})
        for (auto &value : *x)
          value.imag(step * value.imag());
      const auto moved = [&](const double by) {
        VortexLine<double> to = line;
        for (unsigned int i = 0; i < n; ++i)
          {
            to.x[i] += by * std::sin(7. * i);
            to.y[i] += by * std::sin(5. * i);
            to.z[i] += by * std::sin(3. * i);
          }
        return induced_velocity<double>(places[0] + by * way, to, 0.1);
      };
      const Vector3 slope = induced_velocity<Complex>(places[0] + Complex(0, step) * way, shaken, 0.1).imag() / step;
      EXPECT_LT((slope - (moved(h) - moved(-h)) / (2 * h)).norm(), 1e-8) << n;
    }
}



// Many blades of one circulation make a cylinder of vortices. On the disk w = QΓΩ/(4πV) is momentum theory, with
// T = ½ρΩΓQR², and nothing outside of it; where the air comes from the side, H. Glauert's, V_T in place of V, in the
// middle, with the gradient tan(χ/2) of R. P. Coleman, A. M. Feingold & C. W. Stempin (NACA ARR L5E10, 1945).
TEST(HelicalWake, CylinderIsMomentumTheory)
{
  for (const double speed : {30., -30.})
    {
      const Scene scene(
        four_bladed_rotor("helical wake\n    set Speed = " + number_to_text(speed) +
                            "\n    set Transport = 10\n    set Blades = 24\n    set Turns = 40\n    set "
                            "Core = 0.01\n    set Nodes = 3",
                          "rotor.centre"));
      const auto &wake = wake_of(scene);
      const auto  w    = [&](const double x, const double across) {
        std::vector<double>          z(wake.states.size(), 1.);
        ExternalInflow::Flow<double> flow = ExternalInflow::Flow<double>::Zero();
        flow(0)                           = across;
        return -wake.velocity<double>(Vector3(x, 0, 0), flow, z.data())(2);
      };
      const double expected = 24 * 30 / (4 * M_PI * 10);
      for (const double x : {0.5, -1.2, 2.})
        EXPECT_NEAR(w(x, 0.), expected, 0.01 * expected) << x;
      EXPECT_NEAR(w(4.5, 0.), 0., 0.01 * expected);
      for (const double across : {5., 10., 20.})
        {
          const double V_T = std::hypot(10., across), aft = w(0.3, across), ahead = w(-0.3, across);
          EXPECT_NEAR(0.5 * (aft + ahead), expected * 10 / V_T, 0.01 * expected) << across;
          EXPECT_NEAR((aft - ahead) / (aft + ahead) * 3 / 0.3, across / (V_T + 10), 0.02) << across;
        }
    }
}



TEST(HelicalWake, DerivativesAgainstComplexSteps)
{
  const std::string kind =
    "helical wake\n    set Speed = 30\n    set Transport = 7\n    set Nodes = 3\n    set Turns = "
    "2\n    set Segments = 9\n    set Root = 0.5";
  for (const std::string hub : {"ground", "rotor.centre"})
    {
      const Scene       scene(four_bladed_rotor(kind, hub, "12, 3, -1\n    set Gust = sin(x + y), 0, 2*cos(x*z)"));
      const ComplexStep step(scene.system, false, false, true);
      EXPECT_LT(step.error_of_tangent(), 1e-12) << hub;
      EXPECT_LT(step.error_of_damping(), 1e-12) << hub;
    }
}



// Hover: circulation is what the loads say, and the wake that leaves with the flow of momentum theory carries a thrust
// within a tenth of that with Peters and He's radial shapes.
TEST(HelicalWake, HoverAgainstPetersAndHe)
{
  const std::string fine = "    set Breaks = 0.8, 1.6\n";
  Scene             shapes(
    four_bladed_rotor("Peters-He inflow\n    set Harmonics = 0\n    set Power = 8", "rotor.centre", "0, 0, 0", fine));
  shapes.equilibrium();
  const double T = shapes.value("flow.thrust"), nu = shapes.value("flow.mean");
  Scene        lines(four_bladed_rotor(
    "helical wake\n    set Speed = 30\n    set Root = 0.6\n    set Nodes = 8\n    set Turns = 5\n    set "
           "Segments = 12\n    set Transport = " +
      number_to_text(nu),
    "rotor.centre",
    "0, 0, 0",
    fine));
  lines.equilibrium();
  EXPECT_NEAR(lines.value("flow.thrust"), T, 0.1 * T);
  EXPECT_NEAR(lines.value("flow.power"), 30 * lines.value("flow.torque"), 1e-8 * lines.value("flow.power"));
  double       sum = 0;
  const auto  &z   = lines.context.state.states;
  const double dr  = 2.4 / wake_of(lines).states.size();
  for (unsigned int k = 0; k < z.size(); ++k) // ρ Ω Q Σ Γ r dr
    sum += 1.225 * 30 * 4 * z[k] * (0.6 + (k + 0.5) * dr) * dr;
  EXPECT_NEAR(sum, lines.value("flow.thrust"), 0.01 * sum);
}



// Forward flight at μ = 0.15: the thrust over the second half of the second turn is that with Peters and He's shapes
// within a tenth; the flow grows from the front of the disk to the back, by up to a half more than theirs (the wake
// does not roll up, and its nodes are as few as the stations). Finer: doc/theory/aerodynamics.md.
TEST(HelicalWake, FlightBesidePetersAndHe)
{
  struct Means
  {
    double thrust = 0, to_the_back = 0;
  };
  const auto means = [](const std::string &inflow) {
    std::string       text = four_bladed_rotor(inflow, "rotor.centre", "13.5, 0, -0.944");
    const std::string axis = "    set Axis   = 0, 0, 1\n";
    text.insert(text.find(axis) + axis.size(), "    subsection rotation\n      set Prescribed = 30*t\n    end\n");
    Scene scene(text);
    scene.equilibrium();
    const Model           &model = scene.input.model;
    State                  state = scene.context.state;
    StageIntegrator        integrator(scene.system, Tableau(2, 0.5), 1e-8);
    constexpr unsigned int n = 24; // steps a turn
    Means                  sum;
    state.held = false;
    for (unsigned int i = 1; i <= 2 * n; ++i)
      {
        EXPECT_TRUE(integrator.step(state, 2 * M_PI / 30 / n).converged);
        if (2 * i <= 3 * n)
          continue;
        const double psi = 30 * state.time; // of the first blade, whose probe it is; 0: aft
        sum.thrust += model.probe("flow.thrust").value(state) / (n / 2);
        sum.to_the_back += 2 * std::cos(psi) * model.probe("blade 1.at 2.2.inflow").value(state) / (n / 2);
      }
    return sum;
  };
  const Means lines  = means("helical wake\n    set Speed = 30\n    set Root = 0.6\n    set Nodes = 8\n"
                             "    set Segments = 12\n    set Transport = 2.1"),
              shapes = means("Peters-He inflow\n    set Harmonics = 2\n    set Power = 4");
  EXPECT_NEAR(lines.thrust, shapes.thrust, 0.1 * shapes.thrust);
  EXPECT_GT(lines.to_the_back, shapes.to_the_back);
  EXPECT_LT(lines.to_the_back, 1.5 * shapes.to_the_back);
}



// A wake that does not belong to the rotor is told of.
TEST(HelicalWake, Doubts)
{
  const auto said = [](const std::string &entries) {
    Scene scene(four_bladed_rotor("helical wake\n    set Nodes = 3\n    set Turns = 4\n    set Segments = 12\n    set "
                                  "Root = 0.6\n" +
                                    entries,
                                  "rotor.centre"));
    scene.equilibrium();
    return scene.stream.str();
  };
  EXPECT_EQ(said("    set Speed = 30\n    set Transport = 4.8").find("warning"), std::string::npos);
  EXPECT_NE(said("    set Speed = 25\n    set Transport = 4.8").find("another rotor's"), std::string::npos);
  EXPECT_NE(said("    set Speed = 30\n    set Transport = 12").find("about the same"), std::string::npos);
}



TEST(HelicalWake, Refuses)
{
  const auto of = [](const std::string &entries) {
    return complaint_of(four_bladed_rotor("helical wake\n    set Transport = 7\n" + entries, "rotor.centre"));
  };
  EXPECT_NE(of("").find("<Speed> is needed"), std::string::npos);
  EXPECT_NE(of("    set Speed = 30\n    set Nodes = 20").find("more <Stations>"), std::string::npos);
  EXPECT_NE(of("    set Speed = 30\n    set Root = 3").find("<Root> is not less than"), std::string::npos);
}



namespace
{
  /** Ones on the diagonal of 40 unknowns, a chain of small ones beside it, and three unknowns that all others know. */
  SparseMatrix
  bordered(const double down, const double up)
  {
    const int n = 40, first = 10;
    auto      pattern = std::make_shared<Pattern>();
    pattern->column_start.push_back(0);
    const auto is_dense = [=](const int i) { return i >= first && i < first + 3; };
    for (int j = 0; j < n; ++j)
      {
        for (int i = 0; i < n; ++i)
          if (std::abs(i - j) < 2 || is_dense(i) || is_dense(j))
            pattern->rows.push_back(i);
        pattern->column_start.push_back(pattern->rows.size());
      }
    SparseMatrix A(pattern);
    for (int j = 0; j < n; ++j)
      for (int k = pattern->column_start[j]; k < pattern->column_start[j + 1]; ++k)
        {
          const int    i    = pattern->rows[k];
          const double size = is_dense(i) == is_dense(j) ? 0.2 : is_dense(j) ? down : up;
          A.values[k]       = i == j ? 2. : size * std::cos(3. * i + 5. * j);
        }
    return A;
  }
} // namespace



// States that everything depends on and that act back little are swept over: what that leaves of an error is what is
// said of it. Where they act back all is factorised.
TEST(SweptFactors, LeaveWhatTheySay)
{
  for (const double up : {0.01, 10.})
    {
      const SparseMatrix   A = bordered(0.5, up);
      SweptFactors<double> factors(A.pattern, {10, 11, 12});
      factors.factorize(A.values.data());
      EXPECT_EQ(factors.is_swept, up < 0.1) << factors.left;
      std::vector<double> exact(40), x(40);
      for (unsigned int i = 0; i < 40; ++i)
        exact[i] = std::sin(2. * i + 1);
      A.multiply(exact.data(), x.data());
      factors.solve(x.data());
      double error = 0;
      for (unsigned int i = 0; i < 40; ++i)
        error = std::max(error, std::abs(x[i] - exact[i]));
      EXPECT_LT(error, factors.is_swept ? 3 * factors.left : 1e-10);
      if (factors.is_swept)
        {
          EXPECT_GT(error, 1e-6); // a sweep is not exact
        }
      // complex numbers
      std::vector<std::complex<double>>  values(A.values.begin(), A.values.end() - 1), z(exact.begin(), exact.end());
      SweptFactors<std::complex<double>> complex(A.pattern, {10, 11, 12});
      for (auto &value : values)
        value *= std::complex<double>(0.6, 0.8);
      complex.factorize(values.data());
      EXPECT_EQ(complex.is_swept, factors.is_swept);
      std::vector<double> b(40);
      A.multiply(exact.data(), b.data());
      for (unsigned int i = 0; i < 40; ++i)
        z[i] = std::complex<double>(0.6, 0.8) * b[i];
      complex.solve(z.data());
      for (unsigned int i = 0; i < 40; ++i)
        EXPECT_NEAR(std::abs(z[i] - x[i]), 0., 1e-10);
    }
}
