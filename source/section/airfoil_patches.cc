// The cells of an airfoil: skins, webs, a weight in the nose, the trailing edge.

#include <samara/base/text.h>
#include <samara/section/airfoil_mesh.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace samara
{
  namespace
  {
    using Edge = std::function<dealii::Point<2>(double)>;

    Edge
    straight(const dealii::Point<2> &from, const dealii::Point<2> &to)
    {
      return [=](const double u) { return dealii::Point<2>((1 - u) * from + u * to); };
    }



    /** A straight way from node to node, at @p parameters. */
    Edge
    polyline(const std::vector<dealii::Point<2>> &nodes, const std::vector<double> &parameters)
    {
      return [=](const double v) {
        const auto i = std::min<std::size_t>(
          std::max<std::ptrdiff_t>(std::upper_bound(parameters.begin(), parameters.end(), v) - parameters.begin(), 1) -
            1,
          nodes.size() - 2);
        const double w = (v - parameters[i]) / (parameters[i + 1] - parameters[i]);
        return dealii::Point<2>((1 - w) * nodes[i] + w * nodes[i + 1]);
      };
    }



    /** Distances along the nodes, as fractions of all. */
    std::vector<double>
    fractions_of(const std::vector<dealii::Point<2>> &nodes)
    {
      std::vector<double> result(1, 0.);
      for (std::size_t i = 1; i < nodes.size(); ++i)
        result.push_back(result.back() + nodes[i].distance(nodes[i - 1]));
      for (double &v : result)
        v /= result.back();
      result.back() = 1;
      return result;
    }



    /** The surface between four edges, of Coons: two of u at v = 0 and 1, two of v at u = 0 and 1. */
    std::function<dealii::Point<2>(double, double)>
    between(const Edge &low, const Edge &high, const Edge &left, const Edge &right)
    {
      return [=](const double u, const double v) {
        return dealii::Point<2>(
          (1 - v) * low(u) + v * high(u) + (1 - u) * left(v) + u * right(v) -
          ((1 - u) * (1 - v) * low(0) + u * (1 - v) * low(1) + (1 - u) * v * high(0) + u * v * high(1)));
      };
    }



    std::function<Ply(unsigned int, unsigned int)>
    one_material(const unsigned int material)
    {
      return [=](unsigned int, unsigned int) { return Ply{material, 0}; };
    }



    /** Of the cells between depths, from the outside. */
    std::vector<Ply>
    plies_between(const std::vector<double> &depths, const Wall &wall)
    {
      std::vector<Ply> result;
      for (std::size_t j = 0; j + 1 < depths.size(); ++j)
        {
          double      sum = 0;
          std::size_t i   = 0;
          while (i + 1 < wall.size() && (sum += wall[i].thickness) < 0.5 * (depths[j] + depths[j + 1]))
            ++i;
          result.push_back({wall[i].material, wall[i].angle});
        }
      return result;
    }



    /** Where layers are seen along the way from the nose to the trailing edge, angles turn the other way. */
    std::vector<Ply>
    turned_over(std::vector<Ply> plies)
    {
      for (Ply &ply : plies)
        ply.angle = 0. - ply.angle; // which leaves zero as it is written
      return plies;
    }
  } // namespace



  AirfoilMesh::Place
  AirfoilMesh::inner_of_strip(const double s) const
  {
    return at_depth(s, strip_at(s).thickness);
  }



  void
  AirfoilMesh::add_skins()
  {
    for (const Strip &strip : strips)
      {
        SectionPatch patch;
        const double middle = 0.5 * (strip.a + strip.b);
        patch.name          = "skin " + at_x(middle);
        patch.place         = [outline = outline](const double s, const double depth) {
          return Place(outline->place(s) + depth * outline->inwards(s));
        };
        patch.u   = strip.s;
        patch.v   = strip.depths;
        patch.ply = [plies = plies_between(strip.depths, strip.wall)](unsigned int, const unsigned int j) {
          return plies[j];
        };
        patches.push_back(patch);
      }
  }



  void
  AirfoilMesh::add_web(const unsigned int web)
  {
    const double low_a = faces[4 * web], low_b = faces[4 * web + 1], up_a = faces[4 * web + 2],
                 up_b  = faces[4 * web + 3];
    const double t_low = strip_at(0.5 * (low_a + low_b)).thickness, t_up = strip_at(0.5 * (up_a + up_b)).thickness;
    const Wall  &wall = design.webs[web].wall;

    SectionPatch patch;
    patch.name = "web " + std::to_string(web + 1);
    // down along u, from the side of the trailing edge to that of the nose along v
    patch.place = [=, outline = outline](const double u, const double v) {
      const double s_low = low_a + v * (low_b - low_a), s_up = up_b - v * (up_b - up_a);
      const Place  low(outline->place(s_low) + t_low * outline->inwards(s_low)),
        up(outline->place(s_up) + t_up * outline->inwards(s_up));
      return Place((1 - u) * up + u * low);
    };
    const double height = patch.place(0, 0.5).distance(patch.place(1, 0.5));
    if (!((patch.place(0, 0.5) - patch.place(1, 0.5))[1] > 0))
      fail("there is no room for web " + std::to_string(web + 1) + " between the skins", patch.place(0, 0.5));
    const unsigned int n = std::max(2., std::ceil(height * design.fineness.along / outline->chord - 1e-6));
    for (unsigned int i = 0; i <= n; ++i)
      patch.u.push_back(double(i) / n);
    const double total = thickness_of(wall);
    double       sum   = 0;
    patch.v.push_back(0);
    std::vector<Ply> plies;
    for (const WallPly &ply : wall)
      {
        for (unsigned int k = 1; k <= design.fineness.per_ply; ++k)
          {
            patch.v.push_back((sum + ply.thickness * k / design.fineness.per_ply) / total);
            plies.push_back({ply.material, ply.angle});
          }
        sum += ply.thickness;
      }
    patch.v.back() = 1;
    patch.ply      = [plies](unsigned int, const unsigned int j) { return plies[j]; };
    patches.push_back(patch);
  }



  void
  AirfoilMesh::add_nose()
  {
    if (!(design.nose_to > 0))
      return;
    // nodes of the skins that the weight touches, from below to above
    std::vector<double> s;
    for (const Strip &strip : strips)
      for (const double node : strip.s)
        if (node >= nose[0] && node <= nose[1] && (s.empty() || node > s.back()))
          s.push_back(node);
    const unsigned int m = s.size() - 1, k = std::max(1u, m / 4);
    if (m < 3)
      fail("the weight in the nose needs more cells: let <Elements> be larger", outline->place(outline->nose()));
    const double thickness = strip_at(0.5 * (nose[0] + nose[1])).thickness;
    const Edge   inner_at  = [s, thickness, m, outline = outline](const double index) {
      const auto   i  = std::min<unsigned int>(m - 1, std::max(0., std::floor(index)));
      const double at = s[i] + (index - i) * (s[i + 1] - s[i]);
      return Place(outline->place(at) + thickness * outline->inwards(at));
    };
    SectionPatch patch;
    patch.name  = "the weight in the nose";
    patch.place = between([=](const double u) { return inner_at(u * k); },
                          [=](const double u) { return inner_at(m - u * k); },
                          straight(inner_at(0), inner_at(m)),
                          [=](const double v) { return inner_at(k + v * (m - 2 * k)); });
    for (unsigned int i = 0; i <= k; ++i)
      patch.u.push_back(double(i) / k);
    for (unsigned int j = 0; j <= m - 2 * k; ++j)
      patch.v.push_back(double(j) / (m - 2 * k));
    patch.ply = one_material(design.nose_material);
    patches.push_back(patch);
  }



  void
  AirfoilMesh::add_trailing_edge()
  {
    // through the skins where they end, from the outside, to the middle between them
    std::vector<Place> upper, lower;
    for (const double depth : strips.back().depths)
      upper.push_back(at_depth(end, depth));
    for (const double depth : strips.front().depths)
      lower.push_back(at_depth(begin, depth));
    const Place middle(0.5 * (upper.back() + lower.back()));
    const bool  is_blunt = outline->trailing_edge() > 0;
    // in a sharp edge cells across are those along its tip, half as long as the block
    const unsigned int n =
      is_blunt ? 1 : std::max(1., std::ceil(0.5 * begin * design.fineness.along / outline->chord - 1e-6));
    for (auto *const side : {&upper, &lower})
      {
        const Place skin = side->back();
        for (unsigned int k = 1; k <= n; ++k)
          side->emplace_back(skin + double(k) / n * (middle - skin));
      }
    if (is_blunt)
      add_blunt_trailing_edge(upper, lower);
    else
      add_sharp_trailing_edge(upper, lower);
  }



  /** Of one half of the block, from the outside to the middle. */
  std::vector<Ply>
  AirfoilMesh::trailing_plies(const bool upper) const
  {
    const Strip     &skin   = upper ? strips.back() : strips.front();
    const Ply        middle = {design.trailing_material, 0};
    std::vector<Ply> result =
      design.skins_run_on ? plies_between(skin.depths, skin.wall) : std::vector<Ply>(skin.depths.size() - 1, middle);
    result.push_back(middle);
    return result;
  }



  void
  AirfoilMesh::add_blunt_trailing_edge(const std::vector<Place> &upper, const std::vector<Place> &lower)
  {
    std::vector<Place> nodes = upper;
    nodes.insert(nodes.end(), lower.rbegin() + 1, lower.rend());
    const double       length = outline->length(), from = end, to = begin;
    const unsigned int n = std::max(2., std::ceil((length - end) * design.fineness.along / outline->chord - 1e-6));
    SectionPatch       patch;
    patch.name = "the trailing edge";
    patch.v    = fractions_of(nodes);
    for (unsigned int i = 0; i <= n; ++i)
      patch.u.push_back(double(i) / n);
    patch.place = between([=, outline = outline](const double u) { return outline->place(from + u * (length - from)); },
                          [=, outline = outline](const double u) { return outline->place((1 - u) * to); },
                          polyline(nodes, patch.v),
                          straight(outline->place(length), outline->place(0)));
    std::vector<Ply> plies = trailing_plies(true), of_lower = turned_over(trailing_plies(false));
    plies.insert(plies.end(), of_lower.rbegin(), of_lower.rend());
    patch.ply = [plies](unsigned int, const unsigned int j) { return plies[j]; };
    patches.push_back(patch);
  }



  void
  AirfoilMesh::add_sharp_trailing_edge(const std::vector<Place> &upper, const std::vector<Place> &lower)
  {
    // a triangle: three quadrilaterals about a point G between the middles N, K of its long sides
    const double length = outline->length(), s_N = 0.5 * (end + length), s_K = 0.5 * begin, from = end, to = begin;
    const Place  N = outline->place(s_N), K = outline->place(s_K), M = upper.back();
    const Place  NK(0.5 * (N + K));
    const double back = std::min(0.5 * N.distance(K), 0.5 * NK.distance(M));
    const Place  G(NK + back / NK.distance(M) * (M - NK));
    const auto   v_upper = fractions_of(upper), v_lower = fractions_of(lower);
    const unsigned int n = std::max(2., std::ceil((length - s_N) * design.fineness.along / outline->chord - 1e-6));

    SectionPatch above, below, tip;
    above.name = below.name = tip.name = "the trailing edge";
    auto              plies_above = trailing_plies(true), plies_below = trailing_plies(false);
    const std::size_t n_above = plies_above.size() - 1, n_below = plies_below.size() - 1; // of the skins
    plies_above.resize(upper.size() - 1, plies_above.back());
    plies_below.resize(lower.size() - 1, plies_below.back());
    above.ply = [plies_above](unsigned int, const unsigned int j) { return plies_above[j]; };
    below.ply = [plies = turned_over(plies_below)](unsigned int, const unsigned int j) { return plies[j]; };
    // in the tip plies of the upper side are columns, those of the lower one rows; where both are the outer one goes on
    tip.ply = [=](const unsigned int i, const unsigned int j) {
      const unsigned int row = plies_below.size() - 1 - j;
      return row >= n_below || (i < n_above && i <= row) ? plies_above[i] : plies_below[row];
    };
    tip.tangent = [=, tail = outline->place(0), outline = outline](const Place &x) {
      const auto   way = tail - M, to = x - M;
      const double share    = std::min(1., std::max(0., (tail[0] - x[0]) / (tail[0] - N[0])));
      const bool   is_above = (way[0] * to[1] - way[1] * to[0]) * (way[0] * (N - M)[1] - way[1] * (N - M)[0]) > 0;
      const Place  in       = Place(outline->inwards(is_above ? length - share * (length - s_N) : share * s_K));
      return Eigen::Vector2d(in[1], -in[0]);
    };
    for (unsigned int i = 0; i <= n; ++i)
      above.u.push_back(double(i) / n);
    below.u     = above.u;
    above.v     = v_upper;
    below.v     = v_lower;
    above.place = between([=, outline = outline](const double u) { return outline->place(from + u * (s_N - from)); },
                          straight(M, G),
                          polyline(upper, v_upper),
                          straight(N, G));
    below.place = between([=, outline = outline](const double u) { return outline->place(to + u * (s_K - to)); },
                          straight(M, G),
                          polyline(lower, v_lower),
                          straight(K, G));
    tip.u       = v_upper;
    for (std::size_t i = v_lower.size(); i-- > 0;)
      tip.v.push_back(1 - v_lower[i]);
    tip.place = between(
      straight(N, G),
      [=, outline = outline](const double u) { return outline->place(u * s_K); },
      [=, outline = outline](const double v) { return outline->place(s_N + v * (length - s_N)); },
      straight(G, K));
    patches.insert(patches.end(), {above, below, tip});
  }



  void
  AirfoilMesh::find_finest()
  {
    finest = outline->chord;
    for (const SectionPatch &patch : patches)
      for (std::size_t j = 0; j < patch.v.size(); ++j)
        for (std::size_t i = 0; i < patch.u.size(); ++i)
          {
            const Place x = patch.place(patch.u[i], patch.v[j]);
            if (i > 0)
              finest = std::min(finest, x.distance(patch.place(patch.u[i - 1], patch.v[j])));
            if (j > 0)
              finest = std::min(finest, x.distance(patch.place(patch.u[i], patch.v[j - 1])));
          }
  }



  std::string
  AirfoilMesh::picture(const std::string &title, const Place *const fault) const
  {
    constexpr double   width = 1000, margin = 30, height = 500;
    std::ostringstream svg;
    svg << std::fixed << std::setprecision(2) << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 "
        << width + 2 * margin << ' ' << height << "\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    const auto px   = [&](const Place &x) { return margin + width * outline->x_of(x); };
    const auto py   = [&](const Place &x) { return height / 2 - width * x[1] / outline->chord; };
    const auto line = [&](const std::vector<Place> &points, const char *const colour) {
      svg << "<polyline fill=\"none\" stroke=\"" << colour << "\" points=\"";
      for (const Place &x : points)
        svg << px(x) << ',' << py(x) << ' ';
      svg << "\"/>\n";
    };
    constexpr unsigned int n = 400;
    std::vector<Place>     points;
    for (unsigned int i = 0; i <= n; ++i)
      points.push_back(outline->place(outline->length() * i / n));
    points.push_back(points.front());
    line(points, "black");
    for (const Strip &strip : strips)
      {
        std::vector<Place> ring(1, outline->place(strip.a));
        for (unsigned int i = 0; i <= 20; ++i)
          ring.push_back(at_depth(strip.a + (strip.b - strip.a) * i / 20, strip.thickness));
        ring.push_back(outline->place(strip.b));
        line(ring, "#1f77b4");
      }
    for (unsigned int web = 0; 4 * web + 3 < faces.size() && !strips.empty(); ++web)
      for (const unsigned int i : {0u, 1u})
        line({inner_of_strip(faces[4 * web + i]), inner_of_strip(faces[4 * web + 3 - i])}, "#2ca02c");
    if (fault != nullptr)
      svg << "<circle cx=\"" << px(*fault) << "\" cy=\"" << py(*fault)
          << "\" r=\"14\" fill=\"none\" stroke=\"red\" stroke-width=\"3\"/>\n";
    std::string text;
    for (const char c : title)
      text += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    svg << "<text x=\"" << margin << "\" y=\"" << margin << "\" font-family=\"sans-serif\" font-size=\"15\">" << text
        << "</text>\n</svg>\n";
    return svg.str();
  }
} // namespace samara
