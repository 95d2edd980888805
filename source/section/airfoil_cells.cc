// How the skins of an airfoil are cut into cells.

#include <samara/section/airfoil_mesh.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** Depths that are one but for round-off only once. */
    std::vector<double>
    ascending_depths(std::vector<double> depths, const double same)
    {
      std::sort(depths.begin(), depths.end());
      std::vector<double> result;
      for (const double x : depths)
        if (result.empty() || x - result.back() > same)
          result.push_back(x);
      return result;
    }
  } // namespace



  void
  AirfoilMesh::cut_strips()
  {
    double              thickest = 0;
    std::vector<double> depths(1, 0.);
    for (const Strip &strip : strips)
      {
        double sum = 0;
        for (const WallPly &ply : strip.wall)
          depths.push_back(sum += ply.thickness);
        thickest = std::max(thickest, sum);
      }
    const double same = 1e-6 * thickest;
    depths            = ascending_depths(depths, same);
    for (Strip &strip : strips)
      {
        cut_through(strip, depths, same);
        cut_along(strip);
      }
    for (unsigned int web = 0; web < design.webs.size(); ++web)
      for (const bool upper : {false, true})
        {
          const unsigned int first = 4 * web + (upper ? 2 : 0);
          const double       a = faces[first], b = faces[first + 1];
          for (Strip &strip : strips)
            if (strip.a < 0.5 * (a + b) && strip.b > 0.5 * (a + b))
              cut_over_web(strip, design.webs[web].wall, upper);
        }
  }



  void
  AirfoilMesh::cut_through(Strip &strip, const std::vector<double> &depths, const double same) const
  {
    for (const double d : depths)
      {
        if (d > strip.thickness + same)
          break;
        const double last = strip.depths.empty() ? 0 : strip.depths.back();
        for (unsigned int k = 1; k < design.fineness.per_ply && !strip.depths.empty(); ++k)
          strip.depths.push_back(last + (d - last) * k / design.fineness.per_ply);
        strip.depths.push_back(d);
      }
    strip.thickness = strip.depths.back();
  }



  void
  AirfoilMesh::cut_along(Strip &strip) const
  {
    // cells: not longer than a part of the chord, nor turning by more than 20 degrees; a nose may be as short as the
    // step
    constexpr double    turn = 0.35, step = 1e-3;
    const unsigned int  fine = std::max(64., std::ceil((strip.b - strip.a) / (step * outline->chord)));
    std::vector<double> sum(1, 0.);
    const double        h = (strip.b - strip.a) / fine;
    for (unsigned int i = 0; i < fine; ++i)
      sum.push_back(sum.back() + h * std::max(design.fineness.along / outline->chord,
                                              std::abs(outline->curvature(strip.a + h * (i + 0.5))) / turn));
    const unsigned int n = std::max(1., std::ceil(sum.back() - 1e-6));
    strip.s.push_back(strip.a);
    for (unsigned int k = 1, i = 0; k < n; ++k)
      {
        while (sum[i + 1] < sum.back() * k / n)
          ++i;
        strip.s.push_back(strip.a + h * (i + (sum.back() * k / n - sum[i]) / (sum[i + 1] - sum[i])));
      }
    strip.s.push_back(strip.b);
  }



  void
  AirfoilMesh::cut_over_web(Strip &strip, const Wall &wall, const bool upper) const
  {
    const double total = thickness_of(wall);
    double       sum   = 0;
    strip.s.assign(1, upper ? strip.b : strip.a);
    for (const WallPly &ply : wall)
      {
        for (unsigned int k = 1; k <= design.fineness.per_ply; ++k)
          {
            const double v = (sum + ply.thickness * k / design.fineness.per_ply) / total;
            strip.s.push_back(upper ? strip.b - v * (strip.b - strip.a) : strip.a + v * (strip.b - strip.a));
          }
        sum += ply.thickness;
      }
    strip.s.back() = upper ? strip.a : strip.b;
    std::sort(strip.s.begin(), strip.s.end());
  }
} // namespace samara
