#include <samara/model/compound_signal.h>
#include <samara/model/model.h>

#include <algorithm>

namespace samara
{
  CompoundSignal::CompoundSignal(const std::vector<SignalPointer> &parts)
    : parts(parts)
  {
    gather();
  }



  void
  CompoundSignal::gather()
  {
    const auto append = [](const auto &from, auto &to) { to.insert(to.end(), from.begin(), from.end()); };
    frames.clear();
    coordinates.clear();
    states.clear();
    multipliers.clear();
    for (const auto &part : parts)
      {
        append(part->frames, frames);
        append(part->coordinates, coordinates);
        append(part->states, states);
        append(part->multipliers, multipliers);
      }
  }



  void
  CompoundSignal::resolve(const Model &model)
  {
    for (const auto &part : parts)
      part->resolve(model);
    gather();
  }



  std::vector<double>
  CompoundSignal::variables(const Point<double> &point) const
  {
    std::vector<double> result = {point.time};
    for (const auto &part : parts)
      result.push_back(part->value(point));
    return result;
  }



  double
  CompoundSignal::value(const Point<double> &point) const
  {
    return f(variables(point).data());
  }



  std::complex<double>
  CompoundSignal::value(const Point<std::complex<double>> &point) const
  {
    // along imaginary steps, as responses
    std::vector<double> real = {point.time}, imaginary = {0.};
    for (const auto &part : parts)
      {
        const std::complex<double> value = part->value(point);
        real.push_back(value.real());
        imaginary.push_back(value.imag());
      }
    double change = 0;
    for (unsigned int i = 1; i < real.size(); ++i)
      change += slope(real.data(), i) * imaginary[i];
    return {f(real.data()), change};
  }



  double
  CompoundSignal::rate(const Point<double> &point) const
  {
    const std::vector<double> x   = variables(point);
    double                    sum = slope(x.data(), 0);
    for (unsigned int i = 0; i < parts.size(); ++i)
      sum += slope(x.data(), i + 1) * parts[i]->rate(point);
    return sum;
  }



  void
  CompoundSignal::add_gradient(const Point<double> &point, double *const by_place, double *const by_velocity) const
  {
    const std::vector<double> x = variables(point);
    // where the unknowns of the next part are among all frames, coordinates, states, multipliers
    std::size_t         at[] = {0,
                                6 * frames.size(),
                                6 * frames.size() + coordinates.size(),
                                6 * frames.size() + coordinates.size() + states.size()};
    std::vector<double> place, velocity;
    for (unsigned int i = 0; i < parts.size(); ++i)
      {
        const Signal     &part = *parts[i];
        const std::size_t n[]  = {6 * part.frames.size(),
                                  part.coordinates.size(),
                                  part.states.size(),
                                  part.multipliers.size()};
        place.assign(n[0] + n[1] + n[2] + n[3], 0.);
        velocity.assign(place.size(), 0.);
        const double factor = slope(x.data(), i + 1);
        if (factor != 0)
          part.add_gradient(point, place.data(), velocity.data());
        std::size_t from = 0;
        for (unsigned int kind = 0; kind < 4; ++kind)
          for (std::size_t k = 0; k < n[kind]; ++k, ++from, ++at[kind])
            {
              by_place[at[kind]] += factor * place[from];
              by_velocity[at[kind]] += factor * velocity[from];
            }
      }
  }



  void
  CompoundSignal::pieces(const Point<double> &point, std::vector<double> &result) const
  {
    for (const auto &part : parts)
      part->pieces(point, result);
    own_pieces(variables(point).data(), result);
  }



  double
  CompoundSignal::next_corner(const double from, const double to) const
  {
    double first = own_next_corner(from, to);
    for (const auto &part : parts)
      first = std::min(first, part->next_corner(from, to));
    return first;
  }



  namespace
  {
    class Sum : public CompoundSignal
    {
    public:
      Sum(const std::vector<SignalPointer> &parts, const std::vector<double> &factors)
        : CompoundSignal(parts)
        , factors(factors)
      {}

    protected:
      double
      f(const double *const x) const override
      {
        double sum = 0;
        for (unsigned int i = 0; i < factors.size(); ++i)
          sum += factors[i] * x[i + 1];
        return sum;
      }
      double
      slope(const double *, const unsigned int i) const override
      {
        return i == 0 ? 0. : factors[i - 1];
      }

    private:
      std::vector<double> factors;
    };



    class Saturated : public CompoundSignal
    {
    public:
      Saturated(const SignalPointer &part, const double lower, const double upper)
        : CompoundSignal({part})
        , lower(lower)
        , upper(upper)
      {}

    protected:
      double
      f(const double *const x) const override
      {
        return std::min(std::max(x[1], lower), upper);
      }
      double
      slope(const double *const x, const unsigned int i) const override
      {
        return i == 1 && side(x) == 0 ? 1. : 0.;
      }
      void
      own_pieces(const double *const x, std::vector<double> &result) const override
      {
        result.push_back(side(x));
      }

    private:
      double lower, upper;

      double
      side(const double *const x) const
      {
        return x[1] < lower ? -1. : x[1] > upper ? 1. : 0.;
      }
    };



    class OfLaw : public CompoundSignal
    {
    public:
      OfLaw(const Law &law, const std::vector<SignalPointer> &parts)
        : CompoundSignal(parts)
        , law(law)
      {}

    protected:
      double
      f(const double *const x) const override
      {
        return law.depends_on_state() ? law.value(x) : law.of_time()(x[0]);
      }
      double
      slope(const double *const x, const unsigned int i) const override
      {
        return law.depends_on_state() ? law.derivative(x, i) : i == 0 ? law.of_time().derivative(x[0]) : 0.;
      }
      void
      own_pieces(const double *const x, std::vector<double> &result) const override
      {
        if (!law.depends_on_state() || !law.has_pieces())
          return;
        std::vector<double> own;
        law.pieces(x, own);
        result.insert(result.end(), own.begin(), own.end());
      }
      double
      own_next_corner(const double from, const double to) const override
      {
        return law.next_corner(from, to);
      }

    private:
      Law law;
    };
  } // namespace



  SignalPointer
  sum_of_signals(const std::vector<Summand> &summands)
  {
    std::vector<SignalPointer> parts;
    std::vector<double>        factors;
    for (const auto &summand : summands)
      if (summand.factor != 0)
        {
          parts.push_back(summand.signal);
          factors.push_back(summand.factor);
        }
    return std::make_shared<Sum>(parts, factors);
  }



  SignalPointer
  saturated_signal(const SignalPointer &signal, const double lower, const double upper)
  {
    return std::make_shared<Saturated>(signal, lower, upper);
  }



  SignalPointer
  signal_of_law(const Law &law, Model &model)
  {
    std::vector<SignalPointer> parts;
    for (const auto &path : law.signals())
      parts.push_back(model.signal(path));
    return std::make_shared<OfLaw>(law, parts);
  }
} // namespace samara
