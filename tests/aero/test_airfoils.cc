// Airfoils: derivatives, interpolation, files, and what is refused.

#include <samara/aero/airfoil_table.h>

#include "../scene.h"
#include <gtest/gtest.h>

#include <array>

using namespace samara;

namespace
{
  const std::vector<double> angles = {-180, -170, -20, -10, 0, 8, 10, 12, 14, 20, 170, 180}, machs = {0.3, 0.6, 0.8},
                            lift = {0, .8, -.9, -1.05, 0, .9, 1.05, 1.15, .95, .9, -.8, 0};

  AirfoilTable
  table()
  {
    std::vector<double> radians;
    Eigen::MatrixXd     values(angles.size(), 3);
    for (unsigned int i = 0; i < angles.size(); ++i)
      {
        radians.push_back(angles[i] * M_PI / 180);
        values.row(i) << lift[i], 1.1 * lift[i], 0.8 * lift[i];
      }
    return AirfoilTable(radians, machs, values);
  }

  std::string
  fixed_number(const double value)
  {
    char text[16];
    std::snprintf(text, sizeof text, "%7.2f", value);
    return text;
  }

  /** A file in the fixed format with twelve Mach numbers, so that lines are continued. */
  std::string
  fixed_file()
  {
    std::string text = "TEST AIRFOIL                  121212121212\n";
    for (unsigned int k = 0; k < 3; ++k)
      {
        text += "       ";
        for (unsigned int j = 0; j < 12; ++j)
          text += std::string(j == 9 ? "\n       " : "") + fixed_number(0.05 * (j + 1));
        for (unsigned int i = 0; i < 12; ++i)
          {
            text += "\n" + fixed_number(angles[i]);
            for (unsigned int j = 0; j < 12; ++j)
              text += std::string(j == 9 ? "\n       " : "") + fixed_number(lift[i] * (k + 1) + 0.01 * j);
          }
        text += "\n";
      }
    return text;
  }

  /** The same in the free format. */
  std::string
  free_file()
  {
    std::string text = "# FREE FORMAT\nTEST; 12 12 12 12 12 12\n";
    for (unsigned int k = 0; k < 3; ++k)
      {
        for (unsigned int j = 0; j < 12; ++j)
          text += number_to_text(0.05 * (j + 1)) + " ";
        for (unsigned int i = 0; i < 12; ++i)
          {
            text += "\n" + number_to_text(angles[i]);
            for (unsigned int j = 0; j < 12; ++j)
              text += " " + fixed_number(lift[i] * (k + 1) + 0.01 * j);
          }
        text += "\n";
      }
    return text;
  }

  std::string
  polar_file(const std::string &rows = "-180 0 0.02 0\n0 0.3 0.01 -0.05\n180 0 0.02 0\n")
  {
    const std::string head =
      "! ------- AirfoilInfo v1.01.x Input File\n\"DEFAULT\" InterpOrd ! order\n 2  NumTabs ! tables\n";
    return head +
           "0.75 Re\n True InclUAdata\n 4 NumAlf ! rows\n! Alpha Cl Cd\n-180 0.1 0.1 0\n0 0.5 0.1 0\n90 0 0.1 0\n180 0.1 0.1 0\n" +
           "1.5 Re\n3 NumAlf\n! (deg) (-)\n" + rows;
  }

  std::string
  problem_of(const std::function<void()> &f)
  {
    try
      {
        f();
      }
    catch (const std::invalid_argument &problem)
      {
        return problem.what();
      }
    return "";
  }

  std::string
  replaced(std::string text, const std::string &what, const std::string &by)
  {
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), by);
  }
} // namespace



TEST(AirfoilTables, GoThroughTheirPointsWithOneSlopeAndNotBeyond)
{
  const AirfoilTable t = table();
  for (unsigned int i = 0; i < angles.size(); ++i)
    for (const double factor : {1., 1.1, 0.8})
      EXPECT_NEAR(t.at(angles[i] * M_PI / 180,
                       factor == 1.  ? 0.3 :
                       factor == 1.1 ? 0.6 :
                                       0.8)
                    .value,
                  factor * lift[i],
                  1e-14);
  // the derivatives are those of the cubic through four places of one interval, and of the line between Mach numbers
  const auto slope_of = [](const std::array<double, 4> &x, const std::array<double, 4> &y, const double at) {
    double sum = 0;
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = 0; j < 4; ++j)
        if (j != i)
          {
            double product = y[i] / (x[i] - x[j]);
            for (unsigned int k = 0; k < 4; ++k)
              if (k != i && k != j)
                product *= (at - x[k]) / (x[i] - x[k]);
            sum += product;
          }
    return sum;
  };
  for (unsigned int i = 0; i + 1 < angles.size(); ++i)
    for (const double M : {0.1, 0.2, 0.45, 0.7, 0.9})
      {
        std::array<double, 4> x, y;
        for (unsigned int k = 0; k < 4; ++k)
          {
            x[k] = (angles[i] + (0.1 + 0.25 * k) * (angles[i + 1] - angles[i])) * M_PI / 180;
            y[k] = t.at(x[k], M).value;
          }
        for (const double u : {0.02, 0.3, 0.5, 0.77, 0.98})
          {
            const double a = (angles[i] + u * (angles[i + 1] - angles[i])) * M_PI / 180, h = 0.04;
            const auto   v = t.at(a, M);
            EXPECT_NEAR(v.alpha, slope_of(x, y, a), 1e-11) << i << " " << M;
            EXPECT_NEAR(v.mach, (t.at(a, M + h).value - t.at(a, M - h).value) / (2 * h), 1e-12) << i << " " << M;
          }
      }
  double most = -10, least = 10;
  for (double a = -179.99; a < 180; a += 0.37)
    for (const double M : {0.1, 0.2, 0.45, 0.7, 0.9})
      {
        const double value = t.at(a * M_PI / 180, M).value;
        if (M == 0.1)
          {
            most  = std::max(most, value);
            least = std::min(least, value);
          }
      }
  EXPECT_LE(most, 1.15 + 1e-14);
  EXPECT_GE(least, -1.05 - 1e-14);
  // one slope at the points and at the back
  for (const double a : {-20., 0., 8., 12., 170.})
    EXPECT_NEAR(t.at(a * M_PI / 180 - 1e-12, 0.4).alpha, t.at(a * M_PI / 180 + 1e-12, 0.4).alpha, 1e-8);
  EXPECT_NEAR(t.at(-M_PI, 0.4).alpha, t.at(M_PI, 0.4).alpha, 1e-14);
  // constant outside of the Mach numbers
  EXPECT_EQ(t.at(0.1, 0.).value, t.at(0.1, 0.3).value);
  EXPECT_EQ(t.at(0.1, 5.).value, t.at(0.1, 0.8).value);
}



TEST(AirfoilTables, AnalyticDerivatives)
{
  const Scene scene(R"(
subsection Bodies
  subsection b
    set Type = rigid body
    set Mass = 1
    set Inertia = 1, 1, 1
  end
end
subsection Airfoils
  subsection a
    set Type            = analytic
    set Zero-lift angle = -2 deg
    set Drag            = 0.01, 0.02, 0.5
    set Moment          = -0.05, 0.1
    set Compressible    = true
    set Stall angle     = 15 deg
  end
  subsection linear
    set Type       = analytic
    set Form       = linear
    set Lift slope = 5.7
    set Drag       = 0.01, 0.02, 0.5
  end
end
)");
  for (const auto &item : scene.input.model.items)
    if (const auto *const airfoil = dynamic_cast<const Airfoil *>(item.get()))
      for (const double mach : {0.1, 0.6, 0.95})
        for (double alpha = -3.0; alpha < 3.1; alpha += 0.107)
          {
            const double h = 1e-6;
            const auto   c = airfoil->at(alpha, mach), up = airfoil->at(alpha + h, mach),
                       down = airfoil->at(alpha - h, mach), fast = airfoil->at(alpha, mach + h),
                       slow = airfoil->at(alpha, mach - h);
            EXPECT_NEAR(c.lift_alpha, (up.lift - down.lift) / (2 * h), 1e-6);
            EXPECT_NEAR(c.drag_alpha, (up.drag - down.drag) / (2 * h), 1e-6);
            EXPECT_NEAR(c.moment_alpha, (up.moment - down.moment) / (2 * h), 1e-6);
            EXPECT_NEAR(c.lift_mach, (fast.lift - slow.lift) / (2 * h), 1e-6);
          }
  EXPECT_NEAR(scene.value("linear.lift at 3 0.5"), 5.7 * 3 * M_PI / 180, 1e-14);
  // beyond stall a plate
  EXPECT_NEAR(scene.value("a.lift at 45 0.1"), 1., 1e-5);
  EXPECT_NEAR(scene.value("a.drag at 90 0.1"), 2., 1e-12);
}



TEST(AirfoilTables, C81InBothFormats)
{
  const auto fixed = read_c81(fixed_file(), "f", Beyond::refuse), free = read_c81(free_file(), "f", Beyond::refuse);
  for (const double a : {-175., -33., 0., 3., 12., 100.})
    for (const double M : {0., 0.05, 0.33, 0.6, 1.})
      {
        const double x = a * M_PI / 180;
        EXPECT_DOUBLE_EQ(fixed.lift.at(x, M).value, free.lift.at(x, M).value);
        EXPECT_DOUBLE_EQ(fixed.drag.at(x, M).value, free.drag.at(x, M).value);
        EXPECT_DOUBLE_EQ(fixed.moment.at(x, M).value, free.moment.at(x, M).value);
      }
  // the points themselves: 10 degrees, the eleventh Mach number
  EXPECT_NEAR(fixed.lift.at(10 * M_PI / 180, 0.55).value, 1.05 + 0.1, 1e-12);
  EXPECT_NEAR(fixed.moment.at(10 * M_PI / 180, 0.55).value, 3 * 1.05 + 0.1, 1e-12);
}



TEST(AirfoilTables, AeroDynPolars)
{
  const auto first  = read_aerodyn(polar_file(), "p", Beyond::refuse, 1),
             second = read_aerodyn(polar_file(), "p", Beyond::refuse, 2);
  EXPECT_EQ(first.lift.at(0., 0.2).value, 0.5);
  EXPECT_EQ(second.lift.at(0., 0.2).value, 0.3);
  EXPECT_EQ(second.drag.at(0., 0.2).value, 0.01);
  EXPECT_EQ(second.moment.at(0., 0.2).value, -0.05);
  const auto three = read_aerodyn(polar_file("-180 0 0.02\n0 0.3 0.01\n180 0 0.02\n"), "p", Beyond::refuse, 2);
  EXPECT_EQ(three.moment.at(0., 0.).value, 0.);
}



TEST(AirfoilTables, FaultyFilesAreRefusedWithTheirLine)
{
  const auto c81 = [](const std::string &text, const Beyond beyond = Beyond::refuse) {
    return problem_of([&]() { read_c81(text, "f.c81", beyond); });
  };
  const auto polar = [](const std::string &text, const unsigned int which = 2) {
    return problem_of([&]() { read_aerodyn(text, "f.dat", Beyond::refuse, which); });
  };
  EXPECT_EQ(c81(fixed_file()), "");
  EXPECT_EQ(polar(polar_file()), "");
  const std::string fixed = fixed_file(), free = free_file();
  EXPECT_EQ(c81(replaced(fixed, " -10.00", " -25.00")).rfind("f.c81:10: the angles", 0), 0u)
    << c81(replaced(fixed, " -10.00", " -25.00"));
  EXPECT_NE(c81(replaced(fixed, "   0.10", "   0.03")).find("the Mach numbers"), std::string::npos);
  EXPECT_NE(c81(replaced(free, "-180", "-179")).find("not from -180 to 180"), std::string::npos);
  EXPECT_EQ(c81(replaced(free, "-180", "-179"), Beyond::constant), "");
  EXPECT_NE(c81(replaced(free, "-180", "-190")).find("beyond 180"), std::string::npos);
  EXPECT_EQ(c81(replaced(free, "-170 ", "-17o ")), "f.c81:5: <-17o> is not a number");
  EXPECT_NE(c81(replaced(free, "TEST; 12 12", "TEST; 12 1.5")).find("no count"), std::string::npos);
  EXPECT_NE(c81(replaced(free, "TEST; 12 12", "TEST; 12")).find("six numbers"), std::string::npos);
  EXPECT_NE(c81(free + "1 2 3\n"), "");
  EXPECT_NE(c81(fixed + "1 2 3\n").find("more lines"), std::string::npos);
  EXPECT_NE(c81(free.substr(0, free.size() / 2)).find("the file ends here"), std::string::npos);
  EXPECT_NE(c81("").find("f.c81:1: the file ends here"), std::string::npos);
  EXPECT_NE(c81("TEST\n").find("columns 31 to 42"), std::string::npos);
  EXPECT_NE(polar(polar_file(), 3).find("no table 3"), std::string::npos);
  EXPECT_NE(polar(polar_file("-180 0 0.02 0\n0 0.3 0.01\n180 0 0.02 0\n")).find("a row holds"), std::string::npos);
  EXPECT_NE(polar(polar_file("0 0 0.02 0\n-180 0.3 0.01 0\n180 0 0.02 0\n")).find("must increase"), std::string::npos);
  EXPECT_NE(polar("nothing\n").find("no line says <NumTabs>"), std::string::npos);
  EXPECT_NE(c81(replaced(free, " 1.15", " inf")), "");
}
