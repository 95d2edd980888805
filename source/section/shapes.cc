#include <samara/section/shapes.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace samara
{
  namespace
  {
    using Corner = dealii::Point<2>;

    /** Numbers in ascending order, those that are one but for round-off only once. */
    std::vector<double>
    ascending(std::vector<double> numbers)
    {
      constexpr double one = 1e-9;
      std::sort(numbers.begin(), numbers.end());
      std::vector<double> result;
      for (const double x : numbers)
        if (result.empty() || x - result.back() > one)
          result.push_back(x);
      return result;
    }



    /** Relative depths of the faces of the plies, from 0 to 1. */
    std::vector<double>
    depths_of(const Wall &wall)
    {
      std::vector<double> depths(1, 0.);
      const double        total = thickness_of(wall);
      double              sum   = 0;
      for (const WallPly &ply : wall)
        depths.push_back((sum += ply.thickness) / total);
      depths.back() = 1;
      return depths;
    }



    /** The ply of a wall at a relative depth. */
    Ply
    ply_at(const Wall &wall, const double depth)
    {
      const auto depths = depths_of(wall);
      const auto i      = std::upper_bound(depths.begin() + 1, depths.end() - 1, depth) - depths.begin() - 1;
      return {wall[i].material, wall[i].angle};
    }



    /** Each interval cut into n equal ones. */
    std::vector<double>
    cut(const std::vector<double> &ends, const unsigned int n)
    {
      std::vector<double> result(1, ends.front());
      for (unsigned int i = 0; i + 1 < ends.size(); ++i)
        for (unsigned int k = 1; k <= n; ++k)
          result.push_back(k == n ? ends[i + 1] : ends[i] + (ends[i + 1] - ends[i]) * k / n);
      return result;
    }



    /** Each interval cut into pieces of about the given length, at least @p least in all of them. */
    std::vector<double>
    cut_by_length(const std::vector<double> &ends, const double length, const unsigned int least)
    {
      std::vector<double> result(1, ends.front());
      for (unsigned int i = 0; i + 1 < ends.size(); ++i)
        {
          const double       side = ends[i + 1] - ends[i];
          const unsigned int n    = std::max(1., std::ceil(side / length - 1e-6));
          for (unsigned int k = 1; k <= n; ++k)
            result.push_back(k == n ? ends[i + 1] : ends[i] + side * k / n);
        }
      return result.size() > least ? result : cut(ends, (least + ends.size() - 2) / (ends.size() - 1));
    }



    SectionPatch
    patch_of(const std::function<Corner(double)> &outer,
             const std::function<Corner(double)> &inner,
             const std::vector<double>           &u,
             const std::vector<double>           &depths,
             const Wall                          &wall)
    {
      SectionPatch patch;
      patch.place = [=](const double s, const double v) { return Corner(outer(s) + v * (inner(s) - outer(s))); };
      patch.u     = u;
      patch.v     = depths;
      patch.ply   = [=](unsigned int, const unsigned int j) { return ply_at(wall, 0.5 * (depths[j] + depths[j + 1])); };
      return patch;
    }



    std::function<Corner(double)>
    line(const Corner &from, const Corner &to)
    {
      return [=](const double u) { return Corner((1 - u) * from + u * to); };
    }



    dealii::Tensor<1, 2>
    left_of(const dealii::Tensor<1, 2> &direction)
    {
      dealii::Tensor<1, 2> n;
      n[0] = -direction[1];
      n[1] = direction[0];
      return n / n.norm();
    }



    /** Where the inner faces of two walls that meet at @p corner do. */
    Corner
    inner_corner(const Corner               &corner,
                 const dealii::Tensor<1, 2> &before,
                 const double                depth_before,
                 const dealii::Tensor<1, 2> &after,
                 const double                depth_after)
    {
      const auto   a = left_of(before), b = left_of(after);
      const double det = a[0] * b[1] - a[1] * b[0];
      if (std::abs(det) < 1e-6)
        {
          if (std::abs(depth_before - depth_after) > 1e-9 * depth_before || a * b < 0)
            throw std::invalid_argument("walls in one line that meet need the same thickness");
          return Corner(corner + depth_before * a);
        }
      // n·y = depth for both normals
      const double y0 = (depth_before * b[1] - depth_after * a[1]) / det,
                   y1 = (a[0] * depth_after - b[0] * depth_before) / det;
      return Corner(corner[0] + y0, corner[1] + y1);
    }
  } // namespace



  double
  thickness_of(const Wall &wall)
  {
    double sum = 0;
    for (const WallPly &ply : wall)
      sum += ply.thickness;
    return sum;
  }



  std::vector<SectionPatch>
  wall_patches(const std::vector<Corner> &corners, const std::vector<Wall> &walls, const Fineness &fineness)
  {
    const unsigned int  n = walls.size(), n_corners = corners.size();
    const bool          is_ring = n == n_corners;
    const auto          way     = [&](const unsigned int w) { return corners[(w + 1) % n_corners] - corners[w]; };
    std::vector<double> all_depths;
    double              longest = 0;
    for (unsigned int w = 0; w < n; ++w)
      {
        const auto own = depths_of(walls[w]);
        all_depths.insert(all_depths.end(), own.begin(), own.end());
        longest = std::max(longest, way(w).norm());
      }
    const std::vector<double> depths = cut(ascending(all_depths), fineness.per_ply);

    std::vector<Corner> inner;
    for (unsigned int c = 0; c < n_corners; ++c)
      {
        const unsigned int before = (c + n_corners - 1) % n_corners;
        if (is_ring || (c > 0 && c + 1 < n_corners))
          inner.push_back(
            inner_corner(corners[c], way(before), thickness_of(walls[before]), way(c), thickness_of(walls[c])));
        else
          {
            const unsigned int only = c == 0 ? 0 : n - 1;
            inner.push_back(Corner(corners[c] + thickness_of(walls[only]) * left_of(way(only))));
          }
      }

    std::vector<SectionPatch> patches;
    for (unsigned int w = 0; w < n; ++w)
      {
        const unsigned int next = (w + 1) % n_corners;
        if (!((inner[next] - inner[w]) * way(w) > 1e-6 * way(w).norm_square()))
          throw std::invalid_argument("wall " + std::to_string(w + 1) +
                                      " is too thick for its length: nothing is left of its inner face");
        patches.push_back(patch_of(line(corners[w], corners[next]),
                                   line(inner[w], inner[next]),
                                   cut_by_length({0., 1.}, longest / fineness.along / way(w).norm(), 2),
                                   depths,
                                   walls[w]));
      }
    return patches;
  }



  std::vector<SectionPatch>
  ring_patches(const double radius, const Wall &wall, const Fineness &fineness)
  {
    const double t      = thickness_of(wall);
    const auto   circle = [](const double r) {
      return [r](const double u) { return Corner(r * std::cos(2 * M_PI * u), r * std::sin(2 * M_PI * u)); };
    };
    return {patch_of(circle(radius),
                     circle(radius - t),
                     equal_intervals(std::max(2 * fineness.along, 8u)),
                     cut(depths_of(wall), fineness.per_ply),
                     wall)};
  }



  std::vector<SectionPatch>
  strip_patches(const double width, const Wall &wall, const Fineness &fineness)
  {
    const double t = thickness_of(wall);
    return {patch_of(line({-width / 2, -t / 2}, {width / 2, -t / 2}),
                     line({-width / 2, t / 2}, {width / 2, t / 2}),
                     equal_intervals(std::max(fineness.along, 2u)),
                     cut(depths_of(wall), fineness.per_ply),
                     wall)};
  }



  std::vector<SectionPatch>
  I_patches(const double                 height,
            const std::array<double, 2> &widths,
            const std::array<Wall, 2>   &flanges,
            const Wall                  &web,
            const Fineness              &fineness)
  {
    const double t = thickness_of(web), longest = std::max({height, widths[0], widths[1]}),
                 size     = longest / fineness.along;
    const double inner[2] = {-height / 2 + thickness_of(flanges[0]), height / 2 - thickness_of(flanges[1])};
    if (!(inner[1] - inner[0] > 1e-6 * height))
      throw std::invalid_argument("the flanges are as thick as the section is high: nothing is left for the web");
    const auto web_depths = cut(depths_of(web), fineness.per_ply);

    std::vector<SectionPatch> patches;
    for (unsigned int f = 0; f < 2; ++f)
      {
        // seen from outside a flange runs counter-clockwise round the section: the lower one along 2
        const double b = widths[f], sign = f == 0 ? 1 : -1;
        if (!(b - t > 1e-6 * b))
          throw std::invalid_argument("the web must be thinner than the flanges are wide");
        std::vector<double> at_web;
        for (const double d : web_depths)
          at_web.push_back(0.5 + sign * (d - 0.5) * t / b);
        std::sort(at_web.begin(), at_web.end());
        std::vector<double> u = cut_by_length({0., at_web.front()}, size / b, 2);
        u.insert(u.end(), at_web.begin() + 1, at_web.end());
        const auto rest = cut_by_length({at_web.back(), 1.}, size / b, 2);
        u.insert(u.end(), rest.begin() + 1, rest.end());
        patches.push_back(patch_of(line({-sign * b / 2, -sign * height / 2}, {sign * b / 2, -sign * height / 2}),
                                   line({-sign * b / 2, inner[f]}, {sign * b / 2, inner[f]}),
                                   u,
                                   cut(depths_of(flanges[f]), fineness.per_ply),
                                   flanges[f]));
      }
    // the web runs down, its first ply on the side of −2, as the left wall of a box
    patches.push_back(patch_of(line({-t / 2, inner[1]}, {-t / 2, inner[0]}),
                               line({t / 2, inner[1]}, {t / 2, inner[0]}),
                               cut_by_length({0., 1.}, size / (inner[1] - inner[0]), 2),
                               web_depths,
                               web));
    return patches;
  }
} // namespace samara
