// Where the elements of a beam end.

#include <samara/base/text.h>
#include <samara/cosserat/beam.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    /** In order, and each once. */
    std::vector<double>
    sorted(std::vector<double> abscissae, const double length)
    {
      std::sort(abscissae.begin(), abscissae.end());
      const auto are_equal = [&](const double a, const double b) { return b - a < 1e-9 * length; };
      abscissae.erase(std::unique(abscissae.begin(), abscissae.end(), are_equal), abscissae.end());
      return abscissae;
    }
  } // namespace



  std::vector<double>
  Beam::find_breaks()
  {
    const double L             = curve->length();
    named                      = {{"start", 0.}, {"middle", L / 2}, {"end", L}};
    std::vector<double> breaks = curve->corners();
    breaks.push_back(0.);
    breaks.push_back(L);
    if (const auto sides = sorted(breaks, L); sides.size() < breaks.size())
      model->complaints.add(parameters.where("Points"),
                            "beam <" + name + "> has a side of less than a billionth of its " +
                              number_to_text("%.3g", L) + " m: its place would be lost in round-off. Is a unit wrong?");
    for (const auto &text : frame_names)
      {
        std::string point, place;
        double      x = 0;
        if (!split_at(text, point, place) || !text_to_number(place, x) || x < 0 || x > 1)
          model->complaints.add(parameters.where("Frames"),
                                "a frame is written <name at x> with x from 0 (start) to 1 (end), not <" + text + ">");
        else if (!named.emplace(point, x * L).second)
          model->complaints.add(parameters.where("Frames"), "beam <" + name + "> has a point <" + point + "> already");
        else
          breaks.push_back(x * L);
      }
    return sorted(breaks, L);
  }



  bool
  Beam::find_kinks()
  {
    constexpr unsigned int most = 10000;
    const double           L    = curve->length();
    for (const double x : section->kinks())
      kinks.push_back(x * L);
    for (double s = twist.next_corner(0, L); s < L; s = twist.next_corner(s, L))
      {
        if (kinks.size() > most)
          {
            model->complaints.add(parameters.where("Twist"), "the twist has more than 10000 corners along the beam");
            return false;
          }
        kinks.push_back(s);
      }
    kinks = sorted(kinks, L);
    return true;
  }



  std::vector<double>
  Beam::element_ends(const std::vector<double> &breaks) const
  {
    // as many elements as wanted, in equal lengths as nearly as the breaks allow
    std::vector<double> ends(1, 0.);
    unsigned int        left = std::max<unsigned int>(elements_wish.number, breaks.size() - 1);
    for (unsigned int i = 0; i + 1 < breaks.size(); ++i)
      {
        const double       side   = breaks[i + 1] - breaks[i];
        const unsigned int others = breaks.size() - 2 - i;
        const unsigned int n =
          std::max(1, std::min<int>(left - others, std::lround(left * side / (breaks.back() - breaks[i]))));
        for (unsigned int k = 1; k <= n; ++k)
          ends.push_back(breaks[i] + side * k / n);
        left -= n;
      }
    return ends;
  }



  std::vector<double>
  Beam::moved_to_kinks(std::vector<double> ends, const std::vector<double> &breaks) const
  {
    constexpr double far = 1. / 3; // of the shorter element beside: both keep a third of their length
    const double     L   = curve->length();
    const auto       is  = [&](const double a, const double b) { return std::abs(a - b) < 1e-9 * L; };
    const auto       was = ends;
    for (unsigned int i = 1; i + 1 < ends.size(); ++i)
      {
        if (std::any_of(breaks.begin(), breaks.end(), [&](const double s) { return is(s, was[i]); }))
          continue;
        const double reach = far * std::min(was[i] - was[i - 1], was[i + 1] - was[i]);
        const auto nearer = [&](const double a, const double b) { return std::abs(a - was[i]) < std::abs(b - was[i]); };
        if (const auto nearest = std::min_element(kinks.begin(), kinks.end(), nearer);
            nearest != kinks.end() && std::abs(*nearest - was[i]) < reach)
          ends[i] = *nearest;
      }
    return ends;
  }



  bool
  Beam::take_mesh(const std::vector<double> &breaks)
  {
    try
      {
        const double L = curve->length();
        for (const auto &element : read_mesh(mesh_texts))
          cells.push_back({cells.empty() ? 0. : cells.back().end, element.end * L, element.degree});
        for (const double s : breaks)
          {
            const auto there = [&](const Cell &cell) { return std::abs(cell.end - s) < 1e-9 * L; };
            const auto cell  = std::find_if(cells.begin(), cells.end(), there);
            if (cell != cells.end())
              cell->end = s;
            else if (s > 0)
              throw std::invalid_argument("an element of the mesh must end at " + number_to_text(s / L) +
                                          ", where the beam has a corner, a frame, or a jump of its twist");
          }
        for (unsigned int i = 1; i < cells.size(); ++i)
          cells[i].start = cells[i - 1].end;
        return true;
      }
    catch (const std::invalid_argument &problem)
      {
        model->complaints.add(parameters.where("Mesh"), problem.what());
        return false;
      }
  }



  void
  Beam::make_cells()
  {
    auto breaks = find_breaks();
    if (!find_kinks())
      return;
    // where the twist jumps, sections on both sides of a node are turned against each other
    for (const double x : section->jumps_of_twist())
      breaks.push_back(x * curve->length());
    for (const double s : kinks)
      if (const double h = 1e-9 * curve->length(); std::abs(twist(s + h) - twist(s - h)) > least_jump_of_twist)
        breaks.push_back(s);
    breaks = sorted(breaks, curve->length());
    if (!mesh_texts.empty())
      {
        take_mesh(breaks);
        return;
      }
    const unsigned int needed = breaks.size() - 1;
    if (parameters.is_set("Elements") && elements_wish.error == 0 && elements_wish.number < needed)
      model->complaints.add(
        parameters.where("Elements"),
        "beam <" + name + "> needs " + std::to_string(needed) +
          " elements at least: they end at its corners, at its <Frames>, and where its twist jumps");
    // at kinks too if there are enough of them, or nobody says how many; an automatic mesh begins with degree 2
    auto all = breaks;
    all.insert(all.end(), kinks.begin(), kinks.end());
    all = sorted(all, curve->length());
    const bool at_kinks =
      elements_wish.error > 0 || !parameters.is_set("Elements") || elements_wish.number + 1 >= all.size();
    const auto take_ends = [&](const std::vector<double> &ends) {
      cells.clear();
      for (unsigned int i = 0; i + 1 < ends.size(); ++i)
        cells.push_back({ends[i], ends[i + 1], elements_wish.error > 0 ? 2 : degree});
    };
    const auto ends = element_ends(at_kinks ? all : breaks);
    take_ends(ends);
    if (at_kinks || rigid || section->kinks().empty())
      return;
    // equal elements are the best ones unless they miss much of what the section does between stations
    const auto   equal = cells;
    const double error = error_of_cells();
    if (error < much_error_of_sections)
      return;
    take_ends(moved_to_kinks(ends, breaks));
    if (!(error_of_cells() < error))
      cells = equal;
  }



  std::vector<MeshElement>
  Beam::mesh() const
  {
    std::vector<MeshElement> result;
    for (const auto &cell : cells)
      result.push_back({cell.end / curve->length(), cell.degree});
    return result;
  }
} // namespace samara
