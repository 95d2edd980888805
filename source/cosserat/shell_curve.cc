// Curves on shells: taken apart where they go over from one cell to another, and as polynomials in each of them.

#include <samara/base/composite_rule.h>
#include <samara/base/text.h>
#include <samara/cosserat/shell.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace samara
{
  ShellCurve
  Value<ShellCurve>::read(const std::string &text, const std::string &, const Quantities &quantities)
  {
    ShellCurve  curve;
    std::string place;
    if (!split_at(text, curve.name, place) || curve.name.empty())
      throw std::invalid_argument("a curve is written <name at u, v>, with functions of s from 0 to 1, not <" + text +
                                  ">");
    if (const auto of = curve.name.find(" of patch "); of != std::string::npos)
      {
        curve.patch = Value<unsigned int>::read(curve.name.substr(of + 10), "", quantities);
        if (curve.patch == 0)
          throw std::invalid_argument("<" + text + ">: patches are counted from 1");
        --curve.patch;
        curve.name = trim(curve.name.substr(0, of));
      }
    for (const char *word : {"line", "from", "edge", "patch"})
      if (curve.name == word || curve.name.compare(0, std::string(word).size() + 1, std::string(word) + " ") == 0)
        throw std::invalid_argument("a curve cannot be called <" + curve.name + ">: what begins with <" + word +
                                    "> is something else");
    const auto words = split_top_level(place, ',');
    if (words.size() != 2)
      throw std::invalid_argument("<" + text + ">: behind <at> stand u and v, two functions of s");
    curve.u = Value<Expression>::read(words[0], "", quantities);
    curve.v = Value<Expression>::read(words[1], "", quantities);
    return curve;
  }



  std::string
  Value<ShellCurve>::write(const ShellCurve &curve)
  {
    return curve.name + (curve.patch > 0 ? " of patch " + std::to_string(curve.patch + 1) : std::string()) + " at " +
           curve.u.text() + ", " + curve.v.text();
  }



  PatternPointer
  Value<ShellCurve>::pattern()
  {
    return std::make_unique<dealii::Patterns::Anything>();
  }



  namespace
  {
    /** A part of a curve that is in one cell: the one from column i and row j of the patch on. */
    struct CurvePart
    {
      double       from, to; ///< s
      unsigned int i, j;
    };

    /** A curve on the cells of its patch. */
    class CurveOnCells
    {
    public:
      CurveOnCells(const ShellCurve &curve, const ShellMesh &mesh, const ElementTable<2> &table)
        : curve(curve)
        , mesh(mesh)
        , table(table)
        , cells(mesh.patch_cells[curve.patch])
        , xi(line_nodes(table))
      {
        check();
        find_parts();
      }

      std::vector<CurvePart> parts;

      /** The piece of a part whose arc length begins with @p start. */
      CurveInCell piece(const CurvePart &part, double start) const;

    private:
      const ShellCurve            &curve;
      const ShellMesh             &mesh;
      const ElementTable<2>       &table;
      const ShellMesh::PatchCells &cells;
      const std::vector<double>    xi;

      static constexpr unsigned int n_samples = 2000, n_arcs = 64;
      static constexpr double       rounding = 1e-9; ///< of a cell

      void check() const;
      void find_parts();
      /** Add parts from where one is at s = @p a until @p b. */
      void divide(double a, double b);
      /** The cell at s. */
      CurvePart
      part_at(const double s) const
      {
        return {s, s, cells.mesh.u.piece(curve.u(s), rounding), cells.mesh.v.piece(curve.v(s), rounding)};
      }
      unsigned int
      cell_of(const CurvePart &part) const
      {
        return cells.number(part.i, part.j);
      }

      /** Shares of the nodes of the cell in the place at s, and their derivatives by s. At an end of the part the place
       * is on the side of the cell exactly. */
      std::array<Eigen::VectorXd, 2> shares(const CurvePart &part, double s, bool at_end) const;
      /** Size of dx/ds in the reference configuration [m]. */
      double speed(const CurvePart &part, double s) const;
      /** Length from a to b, near to each other [m]. */
      double distance(const CurvePart &part, double a, double b) const;
      /** Arc lengths from the start of the part at n_arcs + 1 places. */
      std::vector<double> lengths(const CurvePart &part) const;
      double              parameter(const CurvePart &part, const std::vector<double> &lengths, double sigma) const;
      /** With so many points; the error of shares between them. */
      std::pair<CurveInCell, double>
      with_points(const CurvePart &part, const std::vector<double> &lengths, unsigned int n) const;

      [[noreturn]] void
      refuse(const std::string &what, const double s) const
      {
        throw std::invalid_argument("curve <" + curve.name + "> " + what + " at s = " + number_to_text("%.4g", s));
      }
    };



    void
    CurveOnCells::check() const
    {
      for (const auto *const f : {&curve.u, &curve.v})
        for (double s = f->next_corner(0., 1.); s < 1.; s = f->next_corner(s, 1.))
          {
            const double h = 1e-9;
            if (std::abs(f->derivative(s + h) - f->derivative(s - h)) > 1e-6 * (1 + std::abs(f->derivative(s + h))) ||
                std::abs((*f)(s + h) - (*f)(s - h)) > 1e-6 * (1 + std::abs((*f)(s))))
              refuse("has a corner or a jump", s);
          }
      for (unsigned int k = 0; k <= n_samples; ++k)
        {
          const double s = double(k) / n_samples, u = curve.u(s), v = curve.v(s);
          if (!std::isfinite(u) || !std::isfinite(v))
            refuse("has no finite u and v", s);
          if (std::min(u, v) < -rounding || std::max(u, v) > 1 + rounding)
            refuse("leaves the patch, on which u and v are from 0 to 1: u = " + number_to_text("%.4g", u) +
                     ", v = " + number_to_text("%.4g", v),
                   s);
          const double slope = std::hypot(curve.u.derivative(s), curve.v.derivative(s));
          if (!std::isfinite(slope) || slope < 1e-6)
            refuse("stands still, or has no finite slope,", s);
        }
    }



    void
    CurveOnCells::divide(const double a, const double b)
    {
      const CurvePart at_b = part_at(b);
      if (parts.back().i == at_b.i && parts.back().j == at_b.j)
        return;
      if (b - a > 1e-14)
        {
          divide(a, 0.5 * (a + b));
          return divide(0.5 * (a + b), b);
        }
      parts.back().to = b;
      parts.push_back(at_b);
    }



    void
    CurveOnCells::find_parts()
    {
      constexpr double least = 1e-6; // of a cell: less is a corner that the curve goes through
      parts.push_back(part_at(0));
      for (unsigned int k = 0; k < n_samples; ++k)
        divide(double(k) / n_samples, double(k + 1) / n_samples);
      parts.back().to = 1;

      std::vector<CurvePart> kept;
      const auto             is_short = [&](const CurvePart &part) {
        double way = 0;
        for (const double s : {0.5 * (part.from + part.to), part.to})
          way = std::max({way,
                          std::abs(curve.u(s) - curve.u(part.from)) / cells.mesh.u.length(part.i),
                          std::abs(curve.v(s) - curve.v(part.from)) / cells.mesh.v.length(part.j)});
        return way < least;
      };
      for (const CurvePart &part : parts)
        if (!is_short(part))
          {
            if (!kept.empty() && kept.back().i == part.i && kept.back().j == part.j)
              kept.back().to = part.to;
            else
              kept.push_back(part);
          }
      if (kept.empty())
        refuse("stands still", 0);
      for (unsigned int k = 1; k < kept.size(); ++k)
        kept[k - 1].to = kept[k].from;
      kept.front().from = 0;
      kept.back().to    = 1;
      parts             = kept;
    }



    std::array<Eigen::VectorXd, 2>
    CurveOnCells::shares(const CurvePart &part, const double s, const bool at_end) const
    {
      constexpr double on_side   = 2e-6;
      const double     length[2] = {cells.mesh.u.length(part.i), cells.mesh.v.length(part.j)};
      double           at[2]     = {(curve.u(s) - cells.mesh.u.start(part.i)) / length[0],
                                    (curve.v(s) - cells.mesh.v.start(part.j)) / length[1]};
      double           slope[2]  = {curve.u.derivative(s) / length[0], curve.v.derivative(s) / length[1]};
      for (double &x : at)
        if (at_end && std::min(std::abs(x), std::abs(x - 1)) < on_side)
          x = std::round(x);
      if (mesh.cells[cell_of(part)].exchanged)
        {
          std::swap(at[0], at[1]);
          std::swap(slope[0], slope[1]);
        }
      const unsigned int n = xi.size();
      Eigen::MatrixXd    L(n, 2), dL(n, 2);
      for (unsigned int d = 0; d < 2; ++d)
        for (unsigned int a = 0; a < n; ++a)
          {
            double value = 1, derivative = 0;
            for (unsigned int b = 0; b < n; ++b)
              if (b != a)
                {
                  const double g = 1 / (xi[a] - xi[b]);
                  derivative     = derivative * (at[d] - xi[b]) * g + value * g;
                  value *= (at[d] - xi[b]) * g;
                }
            L(a, d)  = value;
            dL(a, d) = derivative;
          }
      const auto number = [&](const double x) { return std::lower_bound(xi.begin(), xi.end(), x - 1e-9) - xi.begin(); };
      std::array<Eigen::VectorXd, 2> result = {{Eigen::VectorXd(table.n_nodes), Eigen::VectorXd(table.n_nodes)}};
      for (unsigned int a = 0; a < table.n_nodes; ++a)
        {
          const auto i = number(table.nodes[a][0]), j = number(table.nodes[a][1]);
          result[0](a) = L(i, 0) * L(j, 1);
          result[1](a) = dL(i, 0) * L(j, 1) * slope[0] + L(i, 0) * dL(j, 1) * slope[1];
        }
      return result;
    }



    double
    CurveOnCells::speed(const CurvePart &part, const double s) const
    {
      const Eigen::VectorXd by_s  = shares(part, s, false)[1];
      const auto           &nodes = mesh.cells[cell_of(part)].nodes;
      Vector3               sum   = Vector3::Zero();
      for (unsigned int a = 0; a < nodes.size(); ++a)
        sum += by_s(a) * mesh.nodes[nodes[a]];
      return sum.norm();
    }



    double
    CurveOnCells::distance(const CurvePart &part, const double a, const double b) const
    {
      // the four-point Gauss rule
      static const double x[] = {0.3399810435848563, 0.8611363115940526},
                          w[] = {0.6521451548625461, 0.3478548451374538};
      double sum              = 0;
      for (unsigned int k = 0; k < 2; ++k)
        for (const int sign : {-1, 1})
          sum += w[k] * speed(part, 0.5 * (a + b) + sign * x[k] * 0.5 * (b - a));
      return 0.5 * (b - a) * sum;
    }



    std::vector<double>
    CurveOnCells::lengths(const CurvePart &part) const
    {
      std::vector<double> result(1, 0.);
      const double        h = (part.to - part.from) / n_arcs;
      for (unsigned int k = 0; k < n_arcs; ++k)
        {
          const double length = distance(part, part.from + k * h, part.from + (k + 1) * h);
          if (!(length > 1e-9 * h * mesh.size()))
            refuse("stands still", part.from + k * h);
          result.push_back(result.back() + length);
        }
      return result;
    }



    double
    CurveOnCells::parameter(const CurvePart &part, const std::vector<double> &lengths, const double sigma) const
    {
      const auto   next = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, sigma);
      const auto   i    = next - lengths.begin() - 1;
      const double h = (part.to - part.from) / n_arcs, a = part.from + i * h;
      double       s = a + h * (sigma - lengths[i]) / (lengths[i + 1] - lengths[i]);
      for (unsigned int iteration = 0; iteration < 4; ++iteration)
        s -= (lengths[i] + distance(part, a, s) - sigma) / speed(part, s);
      return std::min(std::max(s, part.from), part.to);
    }



    std::pair<CurveInCell, double>
    CurveOnCells::with_points(const CurvePart &part, const std::vector<double> &lengths, const unsigned int n) const
    {
      CurveInCell piece{cell_of(part), {}, Eigen::MatrixXd(table.n_nodes, n)};
      for (unsigned int k = 0; k < n; ++k)
        {
          const bool   at_end = k == 0 || k + 1 == n;
          const double sigma  = 0.5 * lengths.back() * (1 - std::cos(M_PI * k / (n - 1)));
          const double s      = k == 0 ? part.from : k + 1 == n ? part.to : parameter(part, lengths, sigma);
          piece.abscissae.push_back(k + 1 == n ? lengths.back() : sigma);
          piece.shares.col(k) = shares(part, s, at_end)[0];
        }
      double error = 0;
      for (unsigned int k = 0; k + 1 < n; ++k)
        {
          const double    sigma = 0.5 * (piece.abscissae[k] + piece.abscissae[k + 1]);
          Eigen::VectorXd sum   = -shares(part, parameter(part, lengths, sigma), false)[0];
          for (unsigned int a = 0; a < n; ++a)
            sum += lagrange(piece.abscissae, a, sigma) * piece.shares.col(a);
          error = std::max(error, sum.cwiseAbs().maxCoeff());
        }
      return {piece, error};
    }



    CurveInCell
    CurveOnCells::piece(const CurvePart &part, const double start) const
    {
      constexpr unsigned int most_points = 33;
      constexpr double       good = 1e-9, tolerable = 1e-6;
      const auto             arcs = lengths(part);
      unsigned int           n    = 2 * table.degree + 1;
      auto                   best = with_points(part, arcs, n);
      while (best.second > good && n + 2 <= most_points)
        {
          n += 2;
          if (auto other = with_points(part, arcs, n); other.second < best.second)
            best = std::move(other);
        }
      if (!(best.second < tolerable))
        refuse("bends too much within " + mesh.name_of(best.first.cell) +
                 " to be followed there: take more <Elements>;",
               part.from);
      for (double &s : best.first.abscissae)
        s += start;
      return best.first;
    }
  } // namespace



  std::vector<CurveInCell>
  pieces_of(const ShellCurve &curve, const ShellMesh &mesh, const ElementTable<2> &table)
  {
    if (curve.patch >= mesh.patch_cells.size())
      throw std::invalid_argument("curve <" + curve.name + "> is on patch " + std::to_string(curve.patch + 1) +
                                  (mesh.patch_cells.empty() ?
                                     ", but only what is made of <Patches> has coordinates u and v" :
                                     "; there are " + std::to_string(mesh.patch_cells.size())));
    const CurveOnCells       on_cells(curve, mesh, table);
    std::vector<CurveInCell> result;
    for (const auto &part : on_cells.parts)
      result.push_back(on_cells.piece(part, result.empty() ? 0. : result.back().abscissae.back()));
    return result;
  }



  void
  Shell::check_curves()
  {
    std::vector<std::string> names = edges();
    for (const ShellCurve &entry : curve_entries)
      try
        {
          if (std::find(names.begin(), names.end(), entry.name) != names.end())
            throw std::invalid_argument("there is a curve, or an edge, <" + entry.name + "> already");
          names.push_back(entry.name);
          pieces_of(entry, *mesh, *table);
        }
      catch (const std::invalid_argument &problem)
        {
          model->complaints.add(parameters.where("Curves"), "shell <" + name + ">: " + problem.what());
          is_faulty = true;
        }
  }



  std::vector<ShellMesh::Origin>
  Shell::origins_of(const std::string &point) const
  {
    double     u = 0, v = 0;
    const auto blank = point.find_first_of(" \t");
    if (blank != std::string::npos && text_to_number(trim(point.substr(0, blank)), u) &&
        text_to_number(trim(point.substr(blank)), v))
      return {{0, u, v, 0}};
    const NamedPoint               at = point_named(point);
    std::vector<ShellMesh::Origin> result;
    for (const auto &origin : mesh->origins)
      if (at.node >= 0 && origin.node == static_cast<unsigned int>(at.node))
        result.push_back(origin);
    if (result.empty())
      throw std::invalid_argument("<" + point + "> has no coordinates u and v");
    return result;
  }



  ShellCurve
  Shell::straight_line(const std::string &path) const
  {
    const auto between = [&](const ShellMesh::Origin &a, const ShellMesh::Origin &b) {
      const auto linear = [](const double from, const double to) {
        return Expression(number_to_text(from) + " + s * (" + number_to_text(to - from) + ")");
      };
      return ShellCurve{path, a.patch, linear(a.u, b.u), linear(a.v, b.v)};
    };
    if (path.compare(0, 5, "line ") == 0)
      {
        double     place   = 0;
        const bool along_v = path.compare(0, 7, "line u ") == 0;
        text_to_number(path.substr(7), place); // as read before
        return along_v ? between({0, place, 0, 0}, {0, place, 1, 0}) : between({0, 0, place, 0}, {0, 1, place, 0});
      }
    const auto to = path.find(" to ");
    if (to == std::string::npos)
      throw std::invalid_argument(
        "a straight line on a shell is written <from a to b>, with names of points or numbers "
        "<from 0.1 0.2 to 0.9 0.7>, not <" +
        path + ">");
    ShellMesh::Origin a{}, b{};
    double            shortest = std::numeric_limits<double>::infinity();
    for (const auto &begin : origins_of(trim(path.substr(5, to - 5))))
      for (const auto &end : origins_of(trim(path.substr(to + 4))))
        if (const double length = std::hypot(end.u - begin.u, end.v - begin.v);
            begin.patch == end.patch && length < shortest)
          {
            shortest = length;
            a        = begin;
            b        = end;
          }
    if (!std::isfinite(shortest))
      throw std::invalid_argument("<" + path + ">: the two points are on no patch together");
    return between(a, b);
  }



  std::vector<LinePiece>
  Shell::curve(const std::string &path) const
  {
    if (node_frames.empty())
      return {};
    std::vector<LinePiece> pieces;
    const auto             add_sides = [&]() {
      for (const Span &span : edge(path))
        pieces.emplace_back(span);
      return pieces;
    };
    const auto named_curve = std::find_if(curve_entries.begin(), curve_entries.end(), [&](const ShellCurve &entry) {
      return entry.name == path;
    });
    const bool is_line     = path.compare(0, 5, "line ") == 0;
    if (named_curve == curve_entries.end())
      {
        if (mesh->edges.count(path) > 0 || path.compare(0, 5, "edge ") == 0 ||
            (is_line && (mesh->patch_cells.empty() || mesh->has_line(path))))
          return add_sides();
        if (!is_line && path.compare(0, 5, "from ") != 0)
          {
            auto known = edges();
            for (const ShellCurve &entry : curve_entries)
              known.push_back(entry.name);
            known.push_back("from 0 0 to 1 1");
            throw std::invalid_argument("shell <" + name + "> has no curve, line or edge <" + path + ">" +
                                        did_you_mean(path, known));
          }
      }
    for (const CurveInCell &part :
         pieces_of(named_curve != curve_entries.end() ? *named_curve : straight_line(path), *mesh, *table))
      {
        LinePiece piece;
        piece.frames    = elements[part.cell].frames;
        piece.abscissae = part.abscissae;
        piece.start     = part.abscissae.front();
        piece.end       = part.abscissae.back();
        piece.shares    = part.shares;
        pieces.push_back(piece);
      }
    return pieces;
  }
} // namespace samara
