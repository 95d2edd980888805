#include <samara/model/item.h>
#include <samara/model/model.h>
#include <samara/report/drawn_model.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace samara
{
  namespace
  {
    /**
     * How finely places of samples are known in the page at least, as parts of the model's size, and how finely what
     * turns about them: half of these is lost, of a quaternion of four numbers four times as much, 2 √(4/4). Together a
     * corner misses 5e-6 at most, and a place of a motion that leads far away is known as well as one at rest.
     */
    constexpr double place_known = 4e-6, turn_known = 1.5e-6;

    /** Diagonal of the box about all samples [m]. */
    double
    size_of(const std::vector<Sample> &samples)
    {
      if (samples.empty())
        return 0;
      Vector3 low = samples[0].x, high = low;
      for (const Sample &s : samples)
        {
          low  = low.cwiseMin(s.x);
          high = high.cwiseMax(s.x);
        }
      return (high - low).norm();
    }



    void
    append(const Vector3 &x, const Matrix3 &R, std::vector<float> &numbers)
    {
      const Eigen::Quaterniond q(R);
      for (const double v : {x(0), x(1), x(2), q.x(), q.y(), q.z(), q.w()})
        numbers.push_back(static_cast<float>(v));
    }
  } // namespace



  Matrix3
  fitted_rotation(const std::vector<Vector3> &a,
                  const std::vector<Vector3> &b,
                  const std::vector<Matrix3> &turns,
                  const double                arm)
  {
    Matrix3 M = Matrix3::Zero();
    for (unsigned int i = 0; i < a.size(); ++i)
      M += b[i] * a[i].transpose();
    for (const Matrix3 &turn : turns)
      M += arm * arm * turn;
    // the orthogonal factor of M = R S by Newton's iteration R ← (R + R⁻ᵀ)/2, scaled so that R has a determinant of one
    constexpr unsigned int most = 60;
    for (unsigned int i = 0; i < most; ++i)
      {
        const double det = M.determinant();
        if (!(det > 0) || !std::isfinite(det))
          return turns.empty() ? Matrix3::Identity().eval() : turns[0];
        M /= std::cbrt(det);
        const Matrix3 next = 0.5 * (M + M.inverse().transpose());
        const double  step = (next - M).norm();
        M                  = next;
        if (step < 1e-14)
          break;
      }
    return M;
  }



  DrawnModel::DrawnModel(const Model &model, const Drawing &first, const Drawing &reference)
    : sample_object(first.samples.size(), 0)
    , names(first.objects)
    , items(first.items)
    , n_cells(first.cells.size())
  {
    for (const auto &corner : first.corners)
      {
        const Sample &s = first.samples[corner.sample];
        const Vector3 r = s.D.transpose() * (corner.x - s.x);
        local.insert(local.end(), {float(r(0)), float(r(1)), float(r(2))});
        corner_sample.push_back(corner.sample);
        sample_object[corner.sample] = corner.object;
      }
    for (const auto &cell : first.cells)
      if (cell.dimension > 0)
        {
          auto &list = cell.dimension == 2 ? quadrilaterals : lines;
          list.insert(list.end(), cell.corners.begin(), cell.corners.begin() + cell.n_corners());
        }
    for (std::size_t i = 0; i < names.size(); ++i)
      {
        const Item *const item = i < first.items.size() ? first.items[i] : nullptr;
        subsections.push_back(item != nullptr ? item->subsection : "");
        kinds.push_back(item != nullptr ? item->kind : "");
      }
    undeformed = fits(reference) ? reference.samples : first.samples;
    find_carriers(model, first);
    find_anchors(reference);
  }



  bool
  DrawnModel::fits(const Drawing &drawing) const
  {
    return drawing.samples.size() == n_samples() && drawing.n_corners() == corner_sample.size() &&
           drawing.n_cells() == n_cells && drawing.n_objects() == n_objects() &&
           (drawing.has_corners() ? drawing.objects == names : !items.empty() && drawing.items == items);
  }



  void
  DrawnModel::find_carriers(const Model &model, const Drawing &first)
  {
    std::map<std::string, int> bodies;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (subsections[i] == "Bodies")
        bodies.emplace(names[i], i);
    for (std::size_t s = 0; s < n_samples(); ++s)
      {
        const int object = sample_object[s], node = first.samples[s].node;
        carriers.push_back(object);
        if (subsections[object] == "Bodies" || node < 0)
          continue;
        const auto body = bodies.find(model.nodes[node].name);
        if (node == 0 || body != bodies.end())
          carriers.back() = node == 0 ? -1 : body->second;
      }
  }



  void
  DrawnModel::find_anchors(const Drawing &reference)
  {
    const double near = 1e-6 * size_of(undeformed);
    anchors.resize(n_objects());
    is_held.assign(n_objects(), false);
    std::vector<std::vector<unsigned int>> own(n_objects());
    for (unsigned int s = 0; s < n_samples(); ++s)
      own[sample_object[s]].push_back(s);
    for (unsigned int o = 0; o < n_objects(); ++o)
      {
        if (subsections[o] == "Bodies")
          for (const Sample &held : reference.attachments)
            for (const unsigned int s : own[o])
              if ((undeformed[s].x - held.x).norm() <= near)
                {
                  if (std::find(anchors[o].begin(), anchors[o].end(), s) == anchors[o].end())
                    anchors[o].push_back(s);
                  break; // the others there move alike
                }
        is_held[o] = !anchors[o].empty();
        if (!is_held[o])
          anchors[o] = own[o];
      }
  }



  std::vector<float>
  DrawnModel::motion(const Drawing &drawing) const
  {
    std::vector<float> numbers;
    numbers.reserve(7 * n_samples());
    for (const Sample &s : drawing.samples)
      append(s.x, s.D, numbers);
    return numbers;
  }



  std::vector<float>
  DrawnModel::rigid_motions(const Drawing &drawing) const
  {
    // triads say how a body turns about the line through two places where it is held, and no more; of one that is free
    // they count as arms of a body as long
    constexpr double   arm_held = 1e-4, arm_free = 0.03;
    std::vector<float> numbers;
    numbers.reserve(7 * n_objects());
    for (unsigned int o = 0; o < n_objects(); ++o)
      {
        std::vector<Vector3> a, b;
        std::vector<Matrix3> turns;
        Vector3              mean_a = Vector3::Zero(), mean_b = Vector3::Zero();
        for (const unsigned int s : anchors[o])
          {
            a.push_back(undeformed[s].x);
            b.push_back(drawing.samples[s].x);
            turns.push_back(drawing.samples[s].D * undeformed[s].D.transpose());
            mean_a += a.back() / anchors[o].size();
            mean_b += b.back() / anchors[o].size();
          }
        double length = 0;
        for (unsigned int i = 0; i < a.size(); ++i)
          {
            a[i] -= mean_a;
            b[i] -= mean_b;
            length = std::max(length, a[i].norm());
          }
        const double  arm = (is_held[o] ? arm_held : arm_free) * (length > 0 ? length : 1.);
        const Matrix3 R   = a.empty() ? Matrix3::Identity().eval() : fitted_rotation(a, b, turns, arm);
        append(mean_b - R * mean_a, R, numbers);
      }
    return numbers;
  }



  double
  DrawnModel::size() const
  {
    Vector3 low = Vector3::Constant(HUGE_VAL), high = -low;
    for (std::size_t i = 0; i < corner_sample.size(); ++i)
      {
        const Sample &s = undeformed[corner_sample[i]];
        const Vector3 x = s.x + s.D * Vector3(local[3 * i], local[3 * i + 1], local[3 * i + 2]);
        low             = low.cwiseMin(x);
        high            = high.cwiseMax(x);
      }
    return corner_sample.empty() ? 0. : (high - low).maxCoeff();
  }



  std::vector<float>
  DrawnModel::steps_of_places() const
  {
    return std::vector<float>(3 * n_samples(), static_cast<float>(place_known * size()));
  }



  std::vector<float>
  DrawnModel::steps_of_turns() const
  {
    std::vector<double> arm(n_samples(), 0.);
    for (std::size_t i = 0; i < corner_sample.size(); ++i)
      arm[corner_sample[i]] =
        std::max(arm[corner_sample[i]], double(std::hypot(local[3 * i], local[3 * i + 1], local[3 * i + 2])));
    std::vector<float> steps;
    steps.reserve(4 * n_samples());
    const double of_all = turn_known * size();
    for (const double a : arm) // a quaternion that is off by δ turns by 2 |δ|
      steps.insert(steps.end(), 4, static_cast<float>(a > of_all ? of_all / a : 1.));
    return steps;
  }



  std::string
  DrawnModel::json(ArrayStream &stream) const
  {
    std::vector<float>         place, turn;
    std::vector<std::uint32_t> object_of(sample_object);
    std::vector<float>         carrier(carriers.begin(), carriers.end());
    for (const Sample &s : undeformed)
      {
        std::vector<float> numbers;
        append(s.x, s.D, numbers);
        place.insert(place.end(), numbers.begin(), numbers.begin() + 3);
        turn.insert(turn.end(), numbers.begin() + 3, numbers.end());
      }
    const std::size_t n    = n_samples();
    std::string       text = "{\"local\":" + stream.add(local, {local.size() / 3, 3}) +
                       ",\"sample\":" + stream.add(corner_sample, {corner_sample.size()}) +
                       ",\"object\":" + stream.add(object_of, {n}) + ",\"carrier\":" + stream.add(carrier, {n}) +
                       ",\"quads\":" + stream.add(quadrilaterals, {quadrilaterals.size()}) +
                       ",\"lines\":" + stream.add(lines, {lines.size()}) + ",\"place\":" + stream.add(place, {n, 3}) +
                       ",\"turn\":" + stream.add(turn, {n, 4}) + ",\"objects\":[";
    for (std::size_t i = 0; i < names.size(); ++i)
      text +=
        (i > 0 ? ",[" : "[") + json_text(names[i]) + "," + json_text(subsections[i]) + "," + json_text(kinds[i]) + "]";
    return text + "]}";
  }
} // namespace samara
