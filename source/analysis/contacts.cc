#include <samara/analysis/contacts.h>
#include <samara/base/text.h>
#include <samara/output/table.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  void
  Contacts::begin(const unsigned int stop, const double time)
  {
    if (open.emplace(stop, contacts.size()).second)
      contacts.push_back({stop, time});
  }



  void
  Contacts::end(const unsigned int stop, const double time)
  {
    const auto found = open.find(stop);
    if (found == open.end())
      return;
    contacts[found->second].is_touched = false;
    contacts[found->second].release    = time;
    open.erase(found);
  }



  void
  Contacts::add(const StepResult &step, const double from, const double to)
  {
    creep.resize(std::max(creep.size(), step.creep.size()), 0.);
    for (unsigned int i = 0; i < step.creep.size(); ++i)
      creep[i] += step.creep[i];

    std::vector<unsigned int> left;
    for (const auto &[stop, contact] : open)
      if (std::none_of(step.touched_stops.begin(), step.touched_stops.end(), [stop = stop](const TouchedStop &s) {
            return s.stop == stop;
          }))
        left.push_back(stop); // where the step began, to round-off
    for (const unsigned int stop : left)
      end(stop, from);

    for (const TouchedStop &s : step.touched_stops)
      {
        if (s.is_touched_at_start)
          begin(s.stop, from);
        // what it did in the step belongs to the contact that was there, or else to the first new one
        const auto        found   = open.find(s.stop);
        const std::size_t of_step = found != open.end() ? found->second : contacts.size();
        for (const Touch &touch : step.touches)
          if (touch.stop == s.stop)
            touch.begins ? begin(s.stop, touch.time) : end(s.stop, touch.time);
        if (of_step == contacts.size())
          {
            // the stages see a touch that the polynomial through them does not
            begin(s.stop, from);
            end(s.stop, to);
          }
        contacts[of_step].depth = std::max(contacts[of_step].depth, s.depth);
        contacts[of_step].loss += s.loss;
      }
  }



  std::vector<double>
  Contacts::to_numbers() const
  {
    std::vector<double> numbers;
    for (const Contact &c : contacts)
      numbers.insert(numbers.end(), {double(c.stop), c.onset, c.release, double(c.is_touched), c.depth, c.loss});
    return numbers;
  }



  void
  Contacts::set_numbers(const std::vector<double> &numbers)
  {
    contacts.clear();
    open.clear();
    for (std::size_t i = 0; i + 6 <= numbers.size(); i += 6)
      {
        const Contact c{static_cast<unsigned int>(numbers[i]),
                        numbers[i + 1],
                        numbers[i + 2],
                        numbers[i + 3] != 0,
                        numbers[i + 4],
                        numbers[i + 5]};
        if (c.is_touched)
          open[c.stop] = contacts.size();
        contacts.push_back(c);
      }
  }



  void
  Contacts::write(const std::string &file, const Layout &layout) const
  {
    Table                table({"stop", "onset [s]", "release [s]", "depth [m or rad]", "damper loss [J]"});
    std::vector<Contact> sorted = contacts;
    std::stable_sort(sorted.begin(), sorted.end(), [](const Contact &a, const Contact &b) {
      return a.onset < b.onset;
    });
    for (const Contact &c : sorted)
      {
        using Cell = Table::Cell;
        table.add_row({Cell(layout.stops[c.stop].name),
                       Cell(c.onset),
                       Cell::optional(c.is_touched ? std::nan("") : c.release),
                       Cell(c.depth),
                       Cell(c.loss)});
      }
    table.write(file);
  }



  std::string
  Contacts::summary(const Layout &layout) const
  {
    struct Sum
    {
      unsigned int n     = 0;
      double       first = 0, depth = 0;
    };
    std::map<unsigned int, Sum> sums;
    for (const Contact &c : contacts)
      {
        Sum &sum  = sums[c.stop];
        sum.first = sum.n++ == 0 ? c.onset : sum.first;
        sum.depth = std::max(sum.depth, c.depth);
      }
    std::string text;
    for (const auto &[stop, sum] : sums)
      text += (text.empty() ? "  " : "\n  ") + layout.stops[stop].name + ": touched " +
              (sum.n == 1 ? "once" : std::to_string(sum.n) + " times") +
              ", first at t = " + number_to_text("%.6g", sum.first) + " s, at most by " +
              number_to_text("%.3g", sum.depth) + (open.count(stop) > 0 ? "; touched at the end" : "");
    return text;
  }



  std::string
  Contacts::creep_summary(const Layout &layout) const
  {
    std::string text;
    for (unsigned int i = 0; i < creep.size(); ++i)
      if (creep[i] > 0)
        text += (text.empty() ? "  " : "\n  ") + layout.frictions[i].name + ": crept " +
                number_to_text("%.3g", creep[i]) + " m where it should stick, slower than " +
                number_to_text("%.3g", FrictionLaw::creeping * layout.frictions[i].law.sticking_speed) +
                " m/s; a smaller <Sticking speed> makes it less";
    return text;
  }
} // namespace samara
