// Laws of some pairs of a group of contacts.

#include <samara/base/text.h>
#include <samara/joints/contacts_item.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace samara
{
  namespace
  {
    /** "rubber * with ground friction 0.9": two names, and numbers behind words. */
    struct LawText
    {
      std::array<std::string, 2>    sides;
      std::map<std::string, double> numbers;

      /** @throws std::invalid_argument */
      explicit LawText(const std::string &text);

      bool
      has(const std::string &word) const
      {
        return numbers.count(word) > 0;
      }
      void
      take(const std::string &word, double &value) const
      {
        if (has(word))
          value = numbers.at(word);
      }
    };

    LawText::LawText(const std::string &text)
    {
      static const std::vector<std::string> known = {"stiffness",
                                                     "exponent",
                                                     "damping",
                                                     "restitution",
                                                     "speed",
                                                     "line",
                                                     "friction",
                                                     "static",
                                                     "stribeck",
                                                     "sticking",
                                                     "bristle",
                                                     "bending",
                                                     "rolling",
                                                     "turning"};
      const auto                            with  = text.find(" with ");
      if (with == std::string::npos)
        throw std::invalid_argument("a law is written <a with b friction 0.3>, not <" + text + ">");
      sides[0] = trim(text.substr(0, with));
      std::istringstream words(text.substr(with + 6));
      for (std::string word; words >> word;)
        if (std::find(known.begin(), known.end(), word) != known.end())
          {
            std::string value;
            double      number = 0;
            words >> value;
            if (!text_to_number(value, number) || !std::isfinite(number) || number < 0)
              throw std::invalid_argument("<" + word + "> in <" + text + "> needs a number, not below zero and in SI " +
                                          "units, not <" + value + ">");
            if (!numbers.insert({word, number}).second)
              throw std::invalid_argument("<" + word + "> stands twice in <" + text + ">");
          }
        else if (numbers.empty())
          sides[1] += (sides[1].empty() ? "" : " ") + word;
        else
          throw std::invalid_argument("<" + word + "> in <" + text + "> is no word of a law" +
                                      did_you_mean(word, known));
      if (sides[0].empty() || sides[1].empty())
        throw std::invalid_argument("<" + text +
                                    ">: two bodies stand in front of what is said of them, <a with b ...>");
      if (numbers.empty())
        throw std::invalid_argument("<" + text + "> says nothing of them: stiffness, friction, ...");
    }



    /** The law that follows from that of the group. @throws std::invalid_argument if it makes no sense. */
    PairLaw
    law_from(const LawText &text, const PairLaw &of_group, double restitution, double speed)
    {
      PairLaw     law     = of_group;
      ContactLaw &contact = law.law;
      if (contact.expression && (text.has("stiffness") || text.has("exponent")))
        contact.expression.reset();
      text.take("stiffness", contact.stiffness);
      text.take("exponent", contact.exponent);
      text.take("damping", contact.damping);
      text.take("restitution", restitution);
      text.take("speed", speed);
      if (contact.exponent < 1)
        throw std::invalid_argument("an exponent below 1");
      if (contact.stiffness == 0 && !contact.expression)
        throw std::invalid_argument("a stiffness of zero");
      if (text.has("restitution") || text.has("speed"))
        {
          if (restitution == 0 || restitution > 1)
            throw std::invalid_argument("a restitution that is not above 0 and at most 1");
          if (restitution < 1 && speed == 0)
            throw std::invalid_argument("a restitution without a speed of impact at which it holds");
          contact.factor = restitution == 1 ? 0. : hunt_crossley_factor(restitution, speed);
        }
      const double line      = law.line_law.stiffness;
      law.line_law           = contact;
      law.line_law.exponent  = 1;
      law.line_law.stiffness = line;
      law.line_law.expression.reset();
      text.take("line", law.line_law.stiffness);

      FrictionLaw &friction = law.friction;
      text.take("friction", friction.kinetic);
      if (text.has("friction"))
        friction.breakaway = friction.kinetic;
      text.take("static", friction.breakaway);
      text.take("stribeck", friction.stribeck_speed);
      text.take("sticking", friction.sticking_speed);
      text.take("bristle", friction.bristle_stiffness);
      if (!friction.has_bristles())
        friction.bristle_damping = 0;
      text.take("bending", friction.bristle_damping);
      if (friction.bristle_damping > 0 && !friction.has_bristles())
        throw std::invalid_argument("bristles that bend with damping, but without a stiffness");
      if (friction.has_bristles() && text.has("sticking"))
        throw std::invalid_argument("a sticking speed beside bristles, which stick without one");
      if (friction.has_bristles() && text.has("bristle") && friction.breakaway == 0)
        throw std::invalid_argument("bristles without friction");
      text.take("rolling", law.rolling);
      text.take("turning", law.turning);
      law.has_friction = friction.breakaway > 0 || law.rolling > 0 || law.turning > 0;
      if (law.has_friction && friction.sticking_speed == 0)
        throw std::invalid_argument("friction with a sticking speed of zero");
      if (friction.breakaway < friction.kinetic)
        throw std::invalid_argument("a static friction below that of what slips");
      if (friction.breakaway > friction.kinetic && !text.has("stribeck") &&
          !(of_group.friction.breakaway > of_group.friction.kinetic))
        throw std::invalid_argument("a static friction without a Stribeck speed");
      if (friction.breakaway > friction.kinetic && !friction.has_bristles() &&
          friction.stribeck_speed < 10 * friction.sticking_speed)
        throw std::invalid_argument("a Stribeck speed that is less than ten times the sticking speed");
      return law;
    }
  } // namespace



  void
  ContactsItem::add_laws()
  {
    PairLaw                                 of_group = group.laws.front();
    std::vector<std::array<std::string, 2>> sides;
    if (of_group.friction.sticking_speed == 0) // it has no friction: what the laws say may have some
      of_group.friction.sticking_speed = friction.sticking_speed;
    for (const auto &entry : law_entries)
      try
        {
          const LawText text(entry);
          if (text.has("damping") && text.numbers.at("damping") > 0 && !beams.empty())
            throw std::invalid_argument("<" + entry +
                                        ">: in a group with beams no damping is possible; take a restitution");
          try
            {
              group.laws.push_back(law_from(text, of_group, contact.restitution, contact.speed));
            }
          catch (const std::invalid_argument &problem)
            {
              throw std::invalid_argument("<" + entry + "> would have " + problem.what());
            }
          sides.push_back(text.sides);
        }
      catch (const std::invalid_argument &problem)
        {
          complain("Laws", problem.what());
        }
    if (!sides.empty() && sides.size() == law_entries.size())
      assign_laws(sides);
  }



  void
  ContactsItem::assign_laws(const std::vector<std::array<std::string, 2>> &sides)
  {
    const auto is_one = [](const Item *const body, const std::string &pattern) {
      const std::string name = body == nullptr ? "ground" : body->name;
      return pattern.back() == '*' ? name.compare(0, pattern.size() - 1, pattern, 0, pattern.size() - 1) == 0 :
                                     name == pattern;
    };
    // a kind is the set of names that a body answers to
    std::map<std::vector<bool>, unsigned int> kinds;
    std::vector<const Item *>                 one_of_kind;
    std::vector<std::set<const Item *>>       answering(2 * sides.size());
    const auto                                kind_of = [&](const Item *const body) {
      std::vector<bool> answers;
      for (const auto &pair : sides)
        for (const auto &pattern : pair)
          {
            answers.push_back(is_one(body, pattern));
            if (answers.back())
              answering[answers.size() - 1].insert(body);
          }
      return kinds.insert({answers, kinds.size()}).first->second;
    };
    for (auto &bead : group.beads)
      bead.likeness = kind_of(bead.body);
    for (auto &surface : group.surfaces)
      surface.likeness = kind_of(surface.body);
    for (auto &line : group.lines)
      line.likeness = kind_of(line.body);
    for (unsigned int l = 0; l < sides.size(); ++l)
      for (unsigned int i = 0; i < 2; ++i)
        if (const auto &a = answering[2 * l + i], &b = answering[2 * l + 1 - i]; a.empty())
          complain("Laws", "no body of this group is <" + sides[l][i] + ">");
        else if (i == 0 && a.size() == 1 && a == b)
          complain("Laws", "<" + law_entries[l] + ">: a body does not touch itself");

    group.law_of_likes.assign(kinds.size(), std::vector<unsigned int>(kinds.size(), 0));
    for (const auto &[b, number_b] : kinds)
      for (const auto &[a, number_a] : kinds)
        for (unsigned int l = sides.size(); l-- > 0;)
          if ((b[2 * l] && a[2 * l + 1]) || (b[2 * l + 1] && a[2 * l]))
            group.law_of_likes[number_b][number_a] = l + 1;
  }
} // namespace samara
