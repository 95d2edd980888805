// What a study reads from results, and how it measures it.

#include <samara/study/study_quantity.h>

#include "../output/scratch_folder.h"

#include <cmath>

using namespace samara;

namespace
{
  void
  write(const std::string &file, const std::string &text)
  {
    std::ofstream(file) << text;
  }



  Series
  sampled(const std::vector<double> &x, double (*f)(double))
  {
    Series series{x, {}};
    for (const double place : x)
      series.y.push_back(f(place));
    return series;
  }
} // namespace



// Six points determine a polynomial of degree 5, wherever they are.
TEST(Series, InterpolatesQuinticsExactly)
{
  const auto   quintic = [](const double x) { return 1 - x + 3 * x * x * x - 2 * std::pow(x, 5); };
  const Series series  = sampled({0, 0.2, 0.3, 0.55, 0.7, 0.9, 1.1, 1.15, 1.4}, quintic);
  for (double x = 0; x <= 1.4; x += 0.07)
    EXPECT_NEAR(series.at(x), quintic(x), 1e-13) << x;
  EXPECT_EQ(series.at(0.55), series.y[3]);
}



// Its error falls with the sixth power of the distance between the points.
TEST(Series, InterpolationIsOfSixthOrder)
{
  double errors[2] = {0, 0};
  for (const unsigned int k : {0, 1})
    {
      const unsigned int  n = k == 0 ? 20 : 40;
      std::vector<double> x;
      for (unsigned int i = 0; i <= n; ++i)
        x.push_back(3. * i / n);
      const Series series = sampled(x, [](const double t) { return std::sin(4 * t); });
      for (double t = 0.9; t < 2.1; t += 0.013)
        errors[k] = std::max(errors[k], std::abs(series.at(t) - std::sin(4 * t)));
    }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 6, 0.3);
}



TEST(Series, TimeThatIsThereTwiceAndPlacesOutside)
{
  const Series series{{0, 1, 1, 2}, {0, 1, 1, 2}};
  EXPECT_NEAR(series.at(1.5), 1.5, 1e-14);
  EXPECT_EQ(complaint_of([&]() { series.at(2.1); }), "the reference says nothing at 2.1: it goes from 0 to 2");
}



TEST(Series, Norms)
{
  const Series line{{0, 1, 4}, {-3, -2, 1}}, zero{{0, 4}, {0, 0}};
  EXPECT_EQ(norm_of(line, "final"), 1);
  EXPECT_EQ(norm_of(line, "largest"), 3);
  EXPECT_NEAR(norm_of(line, "RMS"), std::sqrt((6.5 + 3 * 2.5) / 4), 1e-15); // trapezoidal rule of y^2
  for (const std::string norm : {"final", "largest", "RMS"})
    EXPECT_NEAR(distance(line, zero, norm), norm_of(line, norm), 1e-15);
  EXPECT_EQ(distance(line, line, "RMS"), 0);
}



TEST(Quantity, Sources)
{
  const StudyQuantity mode("modal: damping ratio 3");
  EXPECT_EQ(mode.name, "damping ratio");
  EXPECT_EQ(mode.mode, 3u);
  EXPECT_EQ(StudyQuantity("energy: balance").analysis(), "dynamic");
  EXPECT_EQ(StudyQuantity("dynamic: tip.displacement y").overrides().back(), "Output/Probes = tip.displacement y");

  const auto complaint = [](const std::string &text) {
    try
      {
        StudyQuantity quantity(text);
      }
    catch (const std::invalid_argument &problem)
      {
        return std::string(problem.what());
      }
    return std::string();
  };
  EXPECT_TRUE(contains(complaint("dynamc: a.b"), "did you mean <dynamic>?"));
  EXPECT_TRUE(contains(complaint("static"), "names no quantity"));
  EXPECT_TRUE(contains(complaint("modal: frequency"), "does not say which mode"));
  EXPECT_TRUE(contains(complaint("modal: frequncy 2"), "did you mean <frequency>?"));

  const StudyQuantity multiplier("floquet: multiplier 2");
  EXPECT_EQ(multiplier.analysis(), "floquet");
  EXPECT_EQ(multiplier.name, "multiplier");
  EXPECT_EQ(multiplier.mode, 2u);
  EXPECT_TRUE(contains(complaint("floquet: growth 1"), "a mode has no <growth>"));
}



TEST(Quantity, ColumnsOfFiles)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/a.csv";
  write(file, "t [s],\"tip, left.displacement y [m]\",b\n0,1,2\n0.5,3,4\n1,5"); // the last line was cut off
  EXPECT_EQ(read_series(file, "tip, left.displacement y").y, std::vector<double>({1, 3}));
  EXPECT_EQ(read_series(file, "tip, left.displacement y [m]").y, std::vector<double>({1, 3}));
  EXPECT_EQ(complaint_of([&]() { read_series(file, "bb"); }), file + " has no column <bb>; did you mean <b>?");
  EXPECT_EQ(complaint_of([&]() { read_series(folder.path + "/none.csv", "b"); }),
            "cannot read " + folder.path + "/none.csv");
  write(file, "t,exact\n0,7\n");
  EXPECT_EQ(read_series(file, "whatever").y, std::vector<double>({7}));
}



TEST(Quantity, FrequenciesInRadiansPerSecond)
{
  const ScratchFolder folder;
  write(folder.path + "/modes.csv", "mode,frequency [rad/s],frequency [Hz]\n1,10,1.6\n2,20,3.2\n");
  EXPECT_EQ(StudyQuantity("modal: frequency 2").read(folder.path).y, std::vector<double>({20}));
  EXPECT_EQ(complaint_of([&]() { StudyQuantity("modal: frequency 3").read(folder.path); }), "there are 2 modes, not 3");
}



// modes.csv is in the order of frequencies; growth rates are told from the largest on, real eigenvalues among them.
TEST(Quantity, GrowthRatesOfModes)
{
  const ScratchFolder folder;
  write(folder.path + "/modes.csv",
        "mode,frequency [rad/s],real [1/s],imaginary [rad/s]\n1,3,-3,0\n2,20,0.5,20\n3,30,-0.25,30\n");
  for (const auto &[number, value] : {std::pair<std::string, double>{"1", 0.5}, {"2", -0.25}, {"3", -3}})
    EXPECT_EQ(StudyQuantity("modal: growth rate " + number).read(folder.path).y, std::vector<double>({value}));
  EXPECT_EQ(StudyQuantity("modal: real 1").read(folder.path).y, std::vector<double>({-3}));
}
