// Where the layups, webs and ends of an airfoil's skins are.

#include <samara/base/text.h>
#include <samara/section/airfoil_mesh.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  AirfoilMesh::AirfoilMesh(std::shared_ptr<const AirfoilOutline> given, const AirfoilDesign &design)
    : outline(std::move(given))
    , design(design)
    , end(outline->length())
  {
    find_spans();
    find_webs();
    find_trailing_edge();
    find_nose();
    find_strips();
    add_folds();
    cut_strips();
    check_inner_faces();
    add_skins();
    for (unsigned int web = 0; web < design.webs.size(); ++web)
      add_web(web);
    add_nose();
    add_trailing_edge();
    for (SectionPatch &patch : patches)
      patch.group = patch.name;
    find_finest();
  }



  void
  AirfoilMesh::fail(const std::string &what, const Place &where) const
  {
    throw AirfoilFault(what, picture(what, &where));
  }



  std::string
  AirfoilMesh::at_x(const double s) const
  {
    return std::string("at x/c = ") + number_to_text("%.4g", outline->x_of(outline->place(s))) + " of the " +
           (s > outline->nose() ? "upper" : "lower") + " side";
  }



  Wall
  AirfoilMesh::wall_at(const double s) const
  {
    const Wall *skin = &design.skin;
    for (const Span &span : spans)
      if (!span.is_added && s >= span.a && s <= span.b)
        skin = span.wall;
    Wall result = *skin;
    for (const Span &span : spans)
      if (span.is_added && s >= span.a && s <= span.b)
        result.insert(result.end(), span.wall->begin(), span.wall->end());
    return result;
  }



  double
  AirfoilMesh::thickness_at(const double s) const
  {
    return thickness_of(wall_at(s));
  }



  AirfoilMesh::Place
  AirfoilMesh::at_depth(const double s, const double depth) const
  {
    return Place(outline->place(s) + depth * outline->inwards(s));
  }



  AirfoilMesh::Place
  AirfoilMesh::inner(const double s) const
  {
    return at_depth(s, thickness_at(s));
  }



  void
  AirfoilMesh::find_spans()
  {
    for (const auto &range : design.ranges)
      {
        const auto add = [&](const double a, const double b) { spans.push_back({a, b, &range.wall, range.is_added}); };
        const double lower[2] = {outline->at(false, range.to), outline->at(false, range.from)},
                     upper[2] = {outline->at(true, range.from), outline->at(true, range.to)};
        if (range.on_lower && range.on_upper && range.from <= 0)
          add(lower[0], upper[1]);
        else
          {
            if (range.on_lower)
              add(lower[0], range.from <= 0 ? outline->nose() : lower[1]);
            if (range.on_upper)
              add(range.from <= 0 ? outline->nose() : upper[0], upper[1]);
          }
      }
  }



  void
  AirfoilMesh::bind_spans(const unsigned int web, const bool upper, const double low, const double high)
  {
    // s grows from the back to the front on the lower side
    const int    first  = 4 * web + (upper ? 2 : 0);
    const double margin = 0.05 * (high - low);
    for (Span &span : spans)
      {
        if (span.a > low - margin && span.a < high + margin)
          {
            span.a    = low;
            span.at_a = first;
          }
        if (span.b > low - margin && span.b < high + margin)
          {
            span.b    = high;
            span.at_b = first + 1;
          }
      }
  }



  double
  AirfoilMesh::face_of(const bool                                  upper,
                       const double                                x,
                       const double                                thickness,
                       const std::function<double(const Place &)> &beyond) const
  {
    const double reach = 0.02 + 2 * thickness / outline->chord;
    double       near = outline->at(upper, std::max(x - reach, 0.)), far = outline->at(upper, std::min(x + reach, 1.));
    for (unsigned int k = 0; k < 60; ++k)
      {
        const double m                                    = 0.5 * (near + far);
        (beyond(at_depth(m, thickness)) < 0 ? near : far) = m;
      }
    return 0.5 * (near + far);
  }



  double
  AirfoilMesh::face_of(const bool upper, const double x, const double thickness) const
  {
    return face_of(upper, x, thickness, [&](const Place &place) { return outline->x_of(place) - x; });
  }



  void
  AirfoilMesh::find_web(const unsigned int web)
  {
    const auto  &own  = design.webs[web];
    const double x[2] = {own.lower, own.upper}, half = 0.5 * thickness_of(own.wall);
    // across a web that leans its thickness is less than along the chord
    const auto half_along = [&](const Place ends[2]) {
      const double lean = outline->chord * (x[1] - x[0]), height = (ends[1] - ends[0])[1];
      return half / outline->chord * std::sqrt(1 + std::pow(lean / height, 2));
    };
    const double on_outline[2] = {outline->at(false, x[0]), outline->at(true, x[1])};
    const Place  of_outline[2] = {outline->place(on_outline[0]), outline->place(on_outline[1])};
    double       reach         = half_along(of_outline);
    double       thickness[2];
    Place        ends[2];
    for (const bool upper : {false, true})
      {
        const double back  = outline->at(upper, std::min(1., x[upper] + reach)),
                     front = outline->at(upper, std::max(0., x[upper] - reach));
        bind_spans(web, upper, std::min(back, front), std::max(back, front));
        thickness[upper] = thickness_at(on_outline[upper]);
        ends[upper]      = at_depth(face_of(upper, x[upper], thickness[upper]), thickness[upper]);
      }
    // it stands between the inner faces, not between the sides of the outline; where these meet it is refused later
    const bool has_room = (ends[1] - ends[0])[1] > 4 * half;
    if (!has_room)
      std::copy(of_outline, of_outline + 2, ends);
    reach = half_along(ends);
    // its faces are parallel to the line of its middle: one that leans meets inner faces, which slope, elsewhere than
    // half its width before and behind the middle
    const auto           middle = ends[1] - ends[0];
    dealii::Tensor<1, 2> to_tail;
    to_tail[0] = -middle[1] / middle.norm();
    to_tail[1] = middle[0] / middle.norm();
    for (const bool upper : {false, true})
      {
        const auto face = [&](const double sign) {
          const auto   beyond = [&](const Place &place) { return (place - ends[0]) * to_tail - sign * half; };
          const double s      = face_of(upper, x[upper] + sign * reach, thickness[upper], beyond);
          if (has_room && std::abs(beyond(at_depth(s, thickness[upper]))) > 1e-6 * half)
            fail("web " + std::to_string(web + 1) + " does not end on the skin " + at_x(s), outline->place(s));
          return s;
        };
        const double b = face(1), f = face(-1);
        faces[4 * web + (upper ? 2 : 0)] = std::min(b, f);
        faces[4 * web + (upper ? 3 : 1)] = std::max(b, f);
      }
  }



  void
  AirfoilMesh::find_webs()
  {
    faces.resize(4 * design.webs.size());
    for (unsigned int web = 0; web < design.webs.size(); ++web)
      find_web(web);
    for (Span &span : spans)
      {
        if (span.at_a >= 0)
          span.a = faces[span.at_a];
        if (span.at_b >= 0)
          span.b = faces[span.at_b];
      }
    // from the trailing edge round the nose and back they come in order
    std::vector<std::array<double, 3>> order;
    for (unsigned int i = 0; i < faces.size(); i += 2)
      order.push_back({{faces[i], faces[i + 1], double(i / 4)}});
    std::sort(order.begin(), order.end());
    for (unsigned int i = 0; i + 1 < order.size(); ++i)
      if (order[i][1] > order[i + 1][0])
        fail("webs " + std::to_string(int(order[i][2]) + 1) + " and " + std::to_string(int(order[i + 1][2]) + 1) +
               " overlap " + at_x(order[i + 1][0]),
             outline->place(order[i + 1][0]));
  }



  double
  AirfoilMesh::gap(const double x) const
  {
    return (inner(outline->at(true, x)) - inner(outline->at(false, x)))[1];
  }



  void
  AirfoilMesh::find_trailing_edge()
  {
    double     x           = design.trailing_from;
    const auto half_around = [&](const double at) {
      return 0.5 * (thickness_at(outline->at(true, at)) + thickness_at(outline->at(false, at)));
    };
    if (x < 0)
      {
        // where half a skin is between the skins, and not nearer to the trailing edge than a skin is thick
        constexpr double step = 1e-3, farthest = 0.3;
        for (x = 1 - step; x > farthest; x -= step)
          if (gap(x) >= 0.5 * half_around(x) && (1 - x) * outline->chord >= half_around(x))
            break;
        if (x <= farthest)
          fail("the skins are too thick for the airfoil: nothing is left between them anywhere behind x/c = " +
                 number_to_text(farthest),
               inner(outline->at(true, 0.5)));
      }
    else if (!(gap(x) > 0.05 * half_around(x)))
      fail("the skins overlap at x/c = " + number_to_text(x) +
             ", where <Trailing edge from> lets the block of the "
             "trailing edge begin: let it begin farther in front",
           inner(outline->at(true, x)));
    trailing_from = x;
    begin         = outline->at(false, x);
    end           = outline->at(true, x);
    for (unsigned int i = 0; i < faces.size(); i += 2)
      if (faces[i] < begin || faces[i + 1] > end)
        fail("web " + std::to_string(i / 4 + 1) + " lies behind x/c = " + number_to_text("%.4g", x) +
               ", where the block of the trailing edge begins",
             outline->place(faces[i]));
    for (const double s : outline->kinks())
      if (s < begin || s > end)
        fail("the outline has a kink " + at_x(s) +
               ", in the block of the trailing edge: let that begin behind it by "
               "<Trailing edge from>",
             outline->place(s));
  }



  void
  AirfoilMesh::find_nose()
  {
    if (!(design.nose_to > 0))
      return;
    if (design.nose_to >= trailing_from)
      fail("the weight in the nose reaches farther than the skins, which end at x/c = " +
             number_to_text("%.4g", trailing_from),
           outline->place(end));
    for (const bool upper : {false, true})
      nose[upper] = face_of(upper, design.nose_to, thickness_at(outline->at(upper, design.nose_to)));
    if (!(nose[0] < outline->nose() && nose[1] > outline->nose() && inner(nose[1])[1] > inner(nose[0])[1]))
      fail("there is no room for the weight in the nose: the skins fill it as far as x/c = " +
             number_to_text("%.4g", design.nose_to),
           outline->place(outline->nose()));
    for (unsigned int i = 0; i < faces.size(); i += 2)
      if (faces[i + 1] > nose[0] && faces[i] < nose[1])
        fail("web " + std::to_string(i / 4 + 1) + " stands in the weight in the nose", outline->place(faces[i]));
  }



  void
  AirfoilMesh::find_strips()
  {
    std::vector<double> breaks = {begin, end};
    for (const Span &span : spans)
      {
        if (span.a >= end || span.b <= begin)
          fail("a range of the skin lies behind x/c = " + number_to_text("%.4g", trailing_from) +
                 ", where the skins end and the block of the trailing edge begins",
               outline->place(0.5 * (span.a + span.b)));
        // plies of a block run on to its end
        const double near = 1e-3 * outline->chord;
        for (const double s : {span.a, span.b})
          if (design.skins_run_on && ((s > near && s < begin) || (s > end && s < outline->length() - near)))
            fail("a range of the skin ends " + at_x(s) + ", in the block of the trailing edge, which begins at x/c = " +
                   number_to_text("%.4g", trailing_from) +
                   " and into which skins run on: let it end in front of that, or at 1",
                 outline->place(s));
        breaks.push_back(span.a);
        breaks.push_back(span.b);
      }
    breaks.insert(breaks.end(), faces.begin(), faces.end());
    if (design.nose_to > 0)
      breaks.insert(breaks.end(), nose.begin(), nose.end());
    breaks.insert(breaks.end(), outline->kinks().begin(), outline->kinks().end());
    std::sort(breaks.begin(), breaks.end());
    const double same = 1e-6 * outline->chord;
    double       last = begin;
    for (double s : breaks)
      {
        if (s <= last + same || s > end)
          continue;
        if (s > end - same)
          s = end;
        const Wall wall = wall_at(0.5 * (last + s));
        strips.push_back({last, s, wall, thickness_of(wall), {}, {}});
        last = s;
      }
    // a weight in the nose lies on one inner face
    if (design.nose_to > 0)
      for (const Strip &strip : strips)
        if (strip.a > nose[0] - same && strip.b < nose[1] + same &&
            std::abs(strip.thickness - strip_at(nose[0] + same).thickness) > same)
          fail("the thickness of the skin changes " + at_x(strip.a) +
                 ", above or below the weight in the nose: it must "
                 "be one there",
               outline->place(strip.a));
    // what is above or below a web has one thickness
    for (unsigned int i = 0; i < faces.size(); i += 2)
      for (const Strip &strip : strips)
        if (strip.a > faces[i] + same && strip.a < faces[i + 1] - same)
          fail("the skin changes above or below web " + std::to_string(i / 4 + 1) + ", " + at_x(strip.a) +
                 ": at a kink there cannot be a web",
               outline->place(strip.a));
  }



  const AirfoilMesh::Strip &
  AirfoilMesh::strip_at(const double s) const
  {
    for (const Strip &strip : strips)
      if (s < strip.b)
        return strip;
    return strips.back();
  }



  namespace
  {
    /** Whether two segments cross, their ends not included. */
    bool
    segments_cross(const dealii::Point<2> &a,
                   const dealii::Point<2> &b,
                   const dealii::Point<2> &c,
                   const dealii::Point<2> &d)
    {
      if (std::max(a[0], b[0]) < std::min(c[0], d[0]) || std::max(c[0], d[0]) < std::min(a[0], b[0]))
        return false;
      const auto side = [](const auto &x, const auto &y, const auto &z) {
        return (y[0] - x[0]) * (z[1] - x[1]) - (y[1] - x[1]) * (z[0] - x[0]);
      };
      return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
    }
  } // namespace



  void
  AirfoilMesh::check_inner_faces() const
  {
    // the inner face, with its steps, as one line; no two parts of it may meet
    std::vector<Place> line;
    for (const Strip &strip : strips)
      {
        constexpr unsigned int n = 6;
        for (unsigned int c = 0; c + 1 < strip.s.size(); ++c)
          for (unsigned int i = 0; i <= n; ++i)
            line.push_back(at_depth(strip.s[c] + (strip.s[c + 1] - strip.s[c]) * i / n, strip.thickness));
      }
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      for (std::size_t j = i + 2; j + 1 < line.size(); ++j)
        if (segments_cross(line[i], line[i + 1], line[j], line[j + 1]))
          fail("the skins overlap at x/c = " + number_to_text("%.4g", outline->x_of(line[i])) +
                 ": they are thicker there than half the airfoil. Let them be thinner, or a thick one end elsewhere",
               line[i]);
    check_webs(line);
  }



  void
  AirfoilMesh::check_webs(const std::vector<Place> &line) const
  {
    // faces of webs, and the one of a weight in the nose, meet nothing on their way
    struct Face
    {
      Place       from, to;
      std::string name;
    };
    std::vector<Face> across;
    for (unsigned int web = 0; web < design.webs.size(); ++web)
      for (const unsigned int i : {0u, 1u})
        {
          const double middle = 0.5 * (faces[4 * web] + faces[4 * web + 1]),
                       over   = 0.5 * (faces[4 * web + 2] + faces[4 * web + 3]);
          across.push_back({at_depth(faces[4 * web + i], strip_at(middle).thickness),
                            at_depth(faces[4 * web + 3 - i], strip_at(over).thickness),
                            "web " + std::to_string(web + 1)});
        }
    if (design.nose_to > 0)
      {
        const double t = strip_at(0.5 * (nose[0] + nose[1])).thickness;
        across.push_back({at_depth(nose[0], t), at_depth(nose[1], t), "the weight in the nose"});
      }
    for (std::size_t i = 0; i < across.size(); ++i)
      {
        // its ends lie on the line: a little shorter it must not meet it
        constexpr double end_part = 1e-3;
        const Face      &face     = across[i];
        const Place from(face.from + end_part * (face.to - face.from)), to(face.to - end_part * (face.to - face.from));
        for (std::size_t k = 0; k + 1 < line.size(); ++k)
          if (segments_cross(from, to, line[k], line[k + 1]))
            fail(face.name + " runs into the skin at x/c = " + number_to_text("%.4g", outline->x_of(line[k])), line[k]);
        for (std::size_t j = i + 1; j < across.size(); ++j)
          if (segments_cross(face.from, face.to, across[j].from, across[j].to))
            fail(face.name + " and " + across[j].name + " cross", face.from);
      }
  }
} // namespace samara
