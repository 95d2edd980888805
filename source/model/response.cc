#include <samara/model/response.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace samara
{
  Response::Response(const Law &law, Model &model)
    : law(law)
  {
    for (const auto &path : law.signals())
      signals.push_back(model.signal(path));
  }



  Response::Response(const SignalPointer &signal)
    : law(Law::word(0), {"signal"})
    , signals{signal}
  {}



  void
  Response::connect(Layout &layout, const Rows &rows)
  {
    // signals may be multipliers of items that come later
    layout.when_numbered([this, &layout, rows]() { couple(layout, rows); });
  }



  void
  Response::couple(Layout &layout, const Rows &rows)
  {
    // first all frames, then all coordinates, states, multipliers: those of the rows before those of the signals
    std::vector<Frame>        frames      = rows.frames;
    std::vector<unsigned int> coordinates = rows.coordinates, states = rows.states, multipliers = rows.multipliers;
    for (const auto &signal : signals)
      {
        signal->resolve(layout.model);
        for (const auto &frame : signal->frames)
          frames.push_back({frame.node}); // signals know their arms
        coordinates.insert(coordinates.end(), signal->coordinates.begin(), signal->coordinates.end());
        states.insert(states.end(), signal->states.begin(), signal->states.end());
        multipliers.insert(multipliers.end(), signal->multipliers.begin(), signal->multipliers.end());
        layout.multipliers_in_laws.insert(layout.multipliers_in_laws.end(),
                                          signal->multipliers.begin(),
                                          signal->multipliers.end());
      }
    layout.couple(block, frames, coordinates, multipliers, states);

    unsigned int at[] = {0,
                         static_cast<unsigned int>(6 * frames.size()),
                         static_cast<unsigned int>(6 * frames.size() + coordinates.size()),
                         static_cast<unsigned int>(6 * frames.size() + coordinates.size() + states.size())};
    const auto   take = [&](std::vector<unsigned int> &places, const unsigned int kind, const unsigned int n) {
      for (unsigned int i = 0; i < n; ++i)
        places.push_back(at[kind]++);
    };
    row_places.clear();
    signal_places.clear();
    take(row_places, 0, 6 * rows.frames.size());
    take(row_places, 1, rows.coordinates.size());
    take(row_places, 2, rows.states.size());
    take(row_places, 3, rows.multipliers.size());
    for (const auto &signal : signals)
      {
        signal_places.emplace_back();
        take(signal_places.back(), 0, 6 * signal->frames.size());
        take(signal_places.back(), 1, signal->coordinates.size());
        take(signal_places.back(), 2, signal->states.size());
        take(signal_places.back(), 3, signal->multipliers.size());
      }
    n_rows = row_places.size();
  }



  const double *
  Response::variables(const Point<double> &point) const
  {
    thread_local std::vector<double> result;
    result.assign(1, point.time);
    for (const auto &signal : signals)
      result.push_back(signal->value(point));
    return result.data();
  }



  template <>
  double
  Response::operator()(const Point<double> &point) const
  {
    return law.value(variables(point));
  }



  template <>
  std::complex<double>
  Response::operator()(const Point<std::complex<double>> &point) const
  {
    // continued along imaginary steps so small that their square is lost: for derivatives by complex steps
    std::vector<double> real = {point.time}, imaginary = {0.};
    for (const auto &signal : signals)
      {
        const std::complex<double> value = signal->value(point);
        real.push_back(value.real());
        imaginary.push_back(value.imag());
      }
    double change = 0;
    for (unsigned int i = 1; i < real.size(); ++i)
      change += law.derivative(real.data(), i) * imaginary[i];
    return {law.value(real.data()), change};
  }



  bool
  Response::is_of_states() const
  {
    return std::all_of(signals.begin(), signals.end(), [](const SignalPointer &signal) {
      return signal->frames.empty() && signal->coordinates.empty() && signal->multipliers.empty();
    });
  }



  double
  Response::rate(const Point<double> &point) const
  {
    const double *const x   = variables(point);
    double              sum = law.derivative(x, 0);
    for (unsigned int i = 0; i < signals.size(); ++i)
      sum += law.derivative(x, i + 1) * signals[i]->rate(point);
    return sum;
  }



  double
  Response::next_corner(const double from, const double to) const
  {
    double first = law.next_corner(from, to);
    for (const auto &signal : signals)
      first = std::min(first, signal->next_corner(from, to));
    return first;
  }



  void
  Response::pieces(const Point<double> &point, std::vector<double> &result) const
  {
    for (const auto &signal : signals)
      signal->pieces(point, result);
    if (!law.has_pieces())
      return;
    std::vector<double> own;
    law.pieces(variables(point), own);
    result.insert(result.end(), own.begin(), own.end());
  }



  template <bool by_velocity>
  void
  Response::add(const Point<double> &point, const Eigen::VectorXd &c, SparseMatrix &A) const
  {
    AssertDimension(c.size(), n_rows);
    const double *const              x = variables(point);
    thread_local std::vector<double> place, velocity;
    // one row of the local matrix for each coefficient, as if it were 1
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(block.size());
    for (unsigned int s = 0; s < signals.size(); ++s)
      {
        const Signal &signal = *signals[s];
        const double  slope  = law.derivative(x, s + 1);
        if (slope == 0)
          continue;
        place.assign(signal_places[s].size(), 0.);
        velocity.assign(signal_places[s].size(), 0.);
        signal.add_gradient(point, place.data(), velocity.data());
        if (!by_velocity)
          for (unsigned int k = 0; k < signal.frames.size(); ++k)
            Eigen::Map<Vector6>(&place[6 * k]) +=
              ad(Eigen::Map<const Vector6>(point.y + 6 * signal.frames[k].node)).transpose() *
              Eigen::Map<const Vector6>(&velocity[6 * k]);
        for (unsigned int i = 0; i < place.size(); ++i)
          gradient(signal_places[s][i]) += slope * (by_velocity ? velocity[i] : place[i]);
      }
    static thread_local Eigen::MatrixXd local;
    local.setZero(block.size(), block.size());
    for (unsigned int i = 0; i < n_rows; ++i)
      local.row(row_places[i]) += c(i) * gradient.transpose();
    block.add(local, A);
  }



  void
  Response::add_tangent(const Point<double> &point, const Eigen::VectorXd &c, SparseMatrix &K) const
  {
    add<false>(point, c, K);
  }



  void
  Response::add_damping(const Point<double> &point, const Eigen::VectorXd &c, SparseMatrix &C) const
  {
    add<true>(point, c, C);
  }
} // namespace samara
