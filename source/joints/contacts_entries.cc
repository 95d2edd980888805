// What users say of a group of contacts, and what becomes of it.

#include <samara/base/composite_rule.h>
#include <samara/base/text.h>
#include <samara/joints/contacts_item.h>

#include <sstream>

namespace samara
{
  /** "drum at 0 0 1 axis 0 1 0 radius 0.2 inside": a body, and numbers behind words. */
  struct ContactsItem::Shape
  {
    std::string                                path;
    std::map<std::string, std::vector<double>> numbers;

    /** @throws std::invalid_argument */
    Shape(const std::string &text, const std::map<std::string, unsigned int> &wanted)
    {
      std::istringstream       words(text);
      std::vector<double>     *of_word = nullptr;
      std::vector<std::string> body;
      for (std::string word; words >> word;)
        if (wanted.count(word) > 0)
          of_word = &numbers[word];
        else if (double number = 0; of_word != nullptr && text_to_number(word, number))
          of_word->push_back(number);
        else if (of_word != nullptr)
          throw std::invalid_argument("<" + word + "> in <" + text + "> is no number, in SI units");
        else
          body.push_back(word);
      path = join(body, " ");
      for (const auto &[word, values] : numbers)
        if (values.size() != wanted.at(word))
          throw std::invalid_argument("<" + text + ">: " + word + " takes " + std::to_string(wanted.at(word)) +
                                      " numbers, not " + std::to_string(values.size()));
      if (path.empty())
        throw std::invalid_argument("<" + text + "> does not begin with a body, or ground");
    }

    bool
    has(const std::string &word) const
    {
      return numbers.count(word) > 0;
    }

    Vector3
    vector(const std::string &word) const
    {
      const auto found = numbers.find(word);
      if (found == numbers.end())
        throw std::invalid_argument("<" + path + ">: say <" + word + "> and three numbers");
      return {found->second[0], found->second[1], found->second[2]};
    }

    double
    above_zero(const std::string &word) const
    {
      const auto found = numbers.find(word);
      if (found == numbers.end() || !(found->second[0] > 0))
        throw std::invalid_argument("<" + path + ">: say <" + word + "> and a number above zero");
      return found->second[0];
    }
  };



  void
  ContactsItem::add_parameters(Parameters &prm)
  {
    prm.add(
      "Balls",
      balls,
      "Bodies with a ball at body.point, the centre if no point is named; ball * stands for all bodies whose names "
      "begin so. Of its own radius in metres: big radius 0.3.");
    prm.add("Ball radius", ball_radius, "Of balls without one of their own [m].", dealii::Patterns::Double(0));
    prm.add("Planes",
            planes,
            "Half spaces fixed to bodies: ground at 0 0 0 normal 0 0 1, a point and the normal towards what touches, "
            "inertial components in the reference configuration, in SI units.");
    prm.add("Cylinders", cylinders, "Endless cylinders, touched from outside: drum at 0 0 0 axis 0 1 0 radius 0.2.");
    prm.add("Tubes", tubes, "The same, touched from inside.");
    prm.add("Hollow balls", hollow_balls, "Touched from inside: bowl at 0 0 1 radius 1.");
    prm.add(
      "Beams",
      beams,
      "Beams of circular section: rope radius 0.01. They touch balls and each other at nearest places, and surfaces at stations.");
    prm.add("Rods",
            rods,
            "Rigid cylinders between two points, with round ends: drum from 0 -0.1 0 to 0 0.1 0 radius 0.05, in the "
            "reference configuration, inertial components, in SI units. They touch balls, beams and each other at "
            "nearest places, as beams do.");
    prm.add("Stations",
            stations,
            "Places at which each element of a beam touches planes, cylinders, tubes and hollow balls.",
            dealii::Patterns::Integer(1, 100));
    prm.add("Line stiffness",
            line_stiffness,
            "Of beams on those surfaces: force per length and penetration [N/m^2].",
            dealii::Patterns::Double(0));
    prm.add("Touching",
            touching,
            "Whether balls and beams touch all others, or surfaces alone.",
            dealii::Patterns::Selection("all|surfaces"));
    prm.add("Overlap",
            overlap,
            "Whether shapes may press into each other in the reference configuration.",
            dealii::Patterns::Selection("refused|allowed"));
    contact.add_parameters(prm, "", false);
    friction.add_parameters(prm, false, false);
    prm.add(
      "Rolling friction",
      rolling,
      "Moment against rolling as part of the force that presses times the radius, of two balls the smaller one [1].",
      dealii::Patterns::Double(0));
    prm.add("Turning friction",
            turning,
            "The same about the normal of the surfaces, against turning on the spot [1].",
            dealii::Patterns::Double(0));
    prm.add(
      "Laws",
      law_entries,
      "What is different between some of the bodies: rubber * with ground friction 0.9 restitution 0.3, a with b "
      "stiffness 1e6, ... Words, each with a number in SI units: stiffness, exponent, damping, restitution, speed "
      "(of impact), line (stiffness of beams), friction, static, stribeck, sticking, bristle (stiffness), bending (damping "
      "of bristles), rolling, turning. Of two that fit the first one holds; what it does not say is that of the group.");
  }



  void
  ContactsItem::complain(const std::string &entry, const std::string &text) const
  {
    model->complaints.add(parameters.where(entry), "contacts <" + name + ">: " + text);
  }



  void
  ContactsItem::add_balls()
  {
    const auto add = [&](const std::string &path, const double radius) {
      const Item *const body = path == "ground" ? nullptr : &model->find<Body>(path.substr(0, path.find('.')), "body");
      if (!(radius > 0))
        throw std::invalid_argument("the ball of <" + path + "> needs a <Ball radius> above zero, or its own: " + path +
                                    " radius 0.1");
      group.beads.push_back({{{model->frame(path), 1.}}, radius, 1., true, body, "<" + path + ">"});
    };
    for (const auto &text : balls)
      try
        {
          const Shape  shape(text, {{"radius", 1}});
          const double radius = shape.has("radius") ? shape.above_zero("radius") : ball_radius;
          if (shape.path.back() != '*')
            {
              add(shape.path, radius);
              continue;
            }
          const std::string prefix = shape.path.substr(0, shape.path.size() - 1);
          bool              is_any = false;
          for (const auto &item : model->items)
            if (dynamic_cast<const Body *>(item.get()) != nullptr && item->name.compare(0, prefix.size(), prefix) == 0)
              {
                add(item->name, radius);
                is_any = true;
              }
          if (!is_any)
            throw std::invalid_argument("there is no body whose name begins with <" + prefix + ">");
        }
      catch (const FollowUp &problem)
        {
          model->complaints.add(parameters.where("Balls"), problem.what());
        }
      catch (const std::invalid_argument &problem)
        {
          complain("Balls", problem.what());
        }
  }



  void
  ContactsItem::add_surfaces(const std::vector<std::string> &texts,
                             const std::string              &entry,
                             const PairShape::Kind           kind,
                             const bool                      hollow)
  {
    const std::string direction = kind == PairShape::plane ? "normal" : "axis";
    for (const auto &text : texts)
      try
        {
          std::map<std::string, unsigned int> words = {{"at", 3}};
          if (kind != PairShape::ball)
            words[direction] = 3;
          if (kind != PairShape::plane)
            words["radius"] = 1;
          const Shape       shape(text, words);
          const Vector3     axis   = kind == PairShape::ball ? Vector3(Vector3::UnitZ()) : shape.vector(direction);
          const double      radius = kind == PairShape::plane ? 0. : shape.above_zero("radius");
          const Item *const body =
            shape.path == "ground" ? nullptr : &model->find<Body>(shape.path.substr(0, shape.path.find('.')), "body");
          const Frame       frame = model->frame_at(model->frame(shape.path), shape.vector("at"), triad_about(axis));
          const std::string noun  = kind == PairShape::plane ? "the plane" :
                                    kind == PairShape::ball  ? "the hollow ball" :
                                    hollow                   ? "the tube" :
                                                               "the cylinder";
          group.surfaces.push_back({kind, hollow, frame, radius, body, noun + " of <" + shape.path + ">"});
        }
      catch (const FollowUp &problem)
        {
          model->complaints.add(parameters.where(entry), problem.what());
        }
      catch (const std::invalid_argument &problem)
        {
          complain(entry, problem.what());
        }
  }



  double
  ContactsItem::corner_of(const std::vector<Span> &spans) const
  {
    constexpr double largest_kink = 0.2; // of a mesh; it is smoothed
    for (unsigned int i = 0; i + 1 < spans.size(); ++i)
      {
        const auto slope = [&](const Span &span, const double s) {
          // N_a' by differences: a tenth of the angle would do
          const double h   = 1e-4 * (span.end - span.start);
          Vector3      sum = Vector3::Zero();
          for (unsigned int a = 0; a < span.frames.size(); ++a)
            sum += (lagrange(span.abscissae, a, s + h) - lagrange(span.abscissae, a, s - h)) / (2 * h) *
                   model->position(span.frames[a]);
          return sum;
        };
        if ((slope(spans[i], spans[i].end) - slope(spans[i + 1], spans[i + 1].start)).norm() > largest_kink)
          return spans[i].end;
      }
    return 0;
  }



  void
  ContactsItem::add_beams()
  {
    for (const auto &text : beams)
      try
        {
          const Shape shape(text, {{"radius", 1}});
          const Body &body  = model->find<Body>(shape.path, "body");
          const auto  spans = body.spans();
          if (spans.empty())
            throw std::invalid_argument("<" + shape.path + "> has no length: it is no beam");
          for (const Span &span : spans)
            for (unsigned int i = 0; i < stations; ++i)
              {
                const double       length = (span.end - span.start) / stations, s = span.start + (i + 0.5) * length;
                ContactGroup::Bead bead{{},
                                        shape.above_zero("radius"),
                                        length,
                                        false,
                                        &body,
                                        "<" + shape.path + "> at s = " + number_to_text("%.4g", s) + " m",
                                        0,
                                        length / (spans.back().end - spans.front().start)};
                for (unsigned int a = 0; a < span.frames.size(); ++a)
                  bead.place.push_back({span.frames[a], lagrange(span.abscissae, a, s)});
                group.beads.push_back(bead);
              }
          if (const double s = corner_of(spans); touching == "all" && (!balls.empty() || n_lines() > 1) && s > 0)
            throw std::invalid_argument("<" + shape.path + "> has a corner at s = " + number_to_text("%.4g", s) +
                                        " m, where nearest places are not determined: make two beams of it, or let "
                                        "<Touching = surfaces>");
          group.lines.push_back({spans, shape.above_zero("radius"), &body, "<" + shape.path + ">"});
        }
      catch (const FollowUp &problem)
        {
          model->complaints.add(parameters.where("Beams"), problem.what());
        }
      catch (const std::invalid_argument &problem)
        {
          complain("Beams", problem.what());
        }
  }



  void
  ContactsItem::add_rods()
  {
    for (const auto &text : rods)
      try
        {
          const Shape       shape(text, {{"from", 3}, {"to", 3}, {"radius", 1}});
          const Vector3     from = shape.vector("from"), to = shape.vector("to");
          const double      radius = shape.above_zero("radius"), length = (to - from).norm();
          const Item *const body =
            shape.path == "ground" ? nullptr : &model->find<Body>(shape.path.substr(0, shape.path.find('.')), "body");
          if (!(length > 1e-3 * radius))
            throw std::invalid_argument("the rod of <" + shape.path + "> has no length: take a ball");
          const Frame frame = model->frame(shape.path);
          const auto  at    = [&](const Vector3 &x) { return model->frame_at(frame, x, Matrix3::Identity()); };
          group.lines.push_back(
            {{{{at(from), at(to)}, {0., length}, 0., length}}, radius, body, "the rod of <" + shape.path + ">"});
        }
      catch (const FollowUp &problem)
        {
          model->complaints.add(parameters.where("Rods"), problem.what());
        }
      catch (const std::invalid_argument &problem)
        {
          complain("Rods", problem.what());
        }
  }



  void
  ContactsItem::check_stations() const
  {
    for (const auto &surface : group.surfaces)
      for (const auto &bead : group.beads)
        if (surface.kind == PairShape::cylinder && !surface.hollow && !bead.is_ball && bead.body != surface.body &&
            0.5 * bead.part >= surface.radius + bead.radius)
          return complain("Cylinders",
                          surface.name + " may slip between two stations of the beam with " + bead.name +
                            ", which are " + number_to_text("%.3g", bead.part) +
                            " m apart: more <Stations>, or take <Rods>, which beams touch anywhere");
  }



  void
  ContactsItem::refuse_unused() const
  {
    const auto does_nothing = [&](const std::vector<std::string> &entries, const std::string &why) {
      for (const auto &entry : entries)
        if (parameters.is_set(entry))
          complain(entry, "<" + entry + "> does nothing: " + why);
    };
    if (std::all_of(balls.begin(), balls.end(), [](const std::string &b) {
          return b.find(" radius ") != std::string::npos;
        }))
      does_nothing({"Ball radius"}, balls.empty() ? "there are no <Balls>" : "all <Balls> have a radius of their own");
    const bool is_on_surface = !beams.empty() && !group.surfaces.empty();
    if (!is_on_surface)
      does_nothing({"Line stiffness", "Stations"},
                   "it is for <Beams> that touch planes, cylinders, tubes or hollow balls");
    if (is_on_surface && balls.empty() && law_entries.empty() && (n_lines() < 2 || touching != "all"))
      does_nothing({"Stiffness", "Exponent", "Force"}, "where beams touch surfaces the <Line stiffness> holds");
    if (law_entries.empty())
      friction.refuse_unused(parameters,
                             "contacts <" + name + ">",
                             model->complaints,
                             {},
                             rolling > 0 || turning > 0 ? "Sticking speed" : "");
  }



  void
  ContactsItem::check_law()
  {
    const std::string whose = "contacts <" + name + ">";
    if ((!balls.empty() || n_lines() > 1) && touching == "all" && !contact.is_given())
      complain("Stiffness", "balls, and beams and rods that touch each other, need a <Stiffness> above zero");
    else if (!balls.empty() && !contact.is_given())
      complain("Stiffness", "balls need a <Stiffness> above zero");
    if (!beams.empty() && !group.surfaces.empty() && line_stiffness == 0)
      complain("Line stiffness", "beams need a <Line stiffness> above zero");
    check_stations();
    refuse_unused();
    PairLaw &all           = group.laws.front();
    all.law                = contact.law(parameters, "", whose, model->complaints);
    all.line_law           = all.law;
    all.line_law.stiffness = line_stiffness;
    all.line_law.exponent  = 1;
    all.line_law.expression.reset();
    if (!beams.empty() && all.law.damping != 0)
      complain("Damping", "beams have no <Damping> of their contacts; take a <Restitution>, which is per force");
    if (friction.is_given() || rolling > 0 || turning > 0)
      {
        all.has_friction = true;
        all.friction     = friction.law(parameters, whose, model->complaints);
        if (all.friction.has_bristles())
          all.friction.sticking_speed = friction.sticking_speed; // of what resists, and where bristles are not known
      }
    all.rolling             = rolling;
    all.turning             = turning;
    group.balls_touch_balls = touching == "all";
  }



  void
  ContactsItem::initialize(Model &m)
  {
    model                      = &m;
    group.name                 = "contacts <" + name + ">";
    group.item                 = this;
    const std::size_t n_before = m.complaints.count();
    add_balls();
    add_beams();
    add_rods();
    add_surfaces(planes, "Planes", PairShape::plane, false);
    add_surfaces(cylinders, "Cylinders", PairShape::cylinder, false);
    add_surfaces(tubes, "Tubes", PairShape::cylinder, true);
    add_surfaces(hollow_balls, "Hollow balls", PairShape::ball, true);
    check_law();
    add_laws();
    if (m.complaints.count() > n_before)
      is_faulty = true;
  }
} // namespace samara
