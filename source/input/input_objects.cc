// The objects of a model: read, placed, initialized, and what is said of faulty ones.

#include <samara/base/text.h>
#include <samara/cosserat/section.h>
#include <samara/input/input.h>
#include <samara/joints/joint.h>
#include <samara/section/layup.h>

#include <algorithm>
#include <iterator>
#include <set>

namespace samara
{
  namespace
  {
    /**
     * Complain about names that are not known, as initialize() would, for an object that has other mistakes and is not
     * initialized.
     */
    void
    check_references(const Outline &object, Model &model)
    {
      const std::set<std::string> points = {"Body A", "Body B", "At", "Point A", "Point B"},
                                  joints = {"Joint", "Joint A", "Joint B"};
      for (const auto &entry : object.entries)
        try
          {
            if (entry.inherited || entry.value.empty())
              continue;
            if (points.count(entry.name) > 0)
              {
                // a body without a point is right for some kinds: then whether it is there is all that can be said
                const std::string path = trim(entry.value);
                if (path == "ground" || path.find('.') != std::string::npos)
                  model.frame(path);
                else
                  model.find<Body>(path, "body");
              }
            else if (entry.name == "Body")
              model.find<Body>(entry.value, "body");
            else if (entry.name == "Section")
              model.find<Section>(entry.value, "section");
            else if (entry.name == "Material")
              model.find<Material>(entry.value, "material");
            else if (entry.name == "Layup")
              model.find<Layup>(entry.value, "layup");
            else if (joints.count(entry.name) > 0)
              model.find<Item>(trim(entry.value.substr(0, entry.value.find('.'))), "joint");
          }
        catch (const std::invalid_argument &problem)
          {
            model.complaints.add(entry.where, problem.what());
          }
    }
  } // namespace



  void
  Input::assemble_drawing(const Catalogue &catalogue, const InputFile &file, const Gaps gaps)
  {
    // with mistakes in the file nothing is assembled: it is refused anyway, and not for its gaps
    const bool stays_open = gaps == Gaps::open || !file.complaints.empty();
    bool       any_closes = false;
    for (const auto &item : model.items)
      if (auto *const joint = dynamic_cast<Joint *>(item.get()))
        {
          joint->closes_all_gaps = assembly.gaps == "closed";
          any_closes             = any_closes || joint->closes_gap();
        }
    if (!any_closes)
      return;
    for (const auto &item : model.items)
      if (auto *const connection = dynamic_cast<Connection *>(item.get()))
        connection->gaps = stays_open ? Gaps::open : Gaps::closed;
    if (stays_open)
      return;
    Input      drawn(catalogue, file, {}, Gaps::open);
    const auto system = drawn.assemble();
    assembled         = std::make_shared<AssembledDrawing>(*system, assembly, root.subsection("Assembly"));
    if (!assembled->has_moved())
      return;
    for (const auto &item : model.items)
      {
        const std::string scope = scope_of(item->name);
        if (auto *const moves = dynamic_cast<MovesWithBodies *>(item.get()))
          moves->be_moved([&](const std::string &path) { return assembled->motion_of(path, scope); });
        else if (const auto *const body = dynamic_cast<const Body *>(item.get()))
          if (const Placement motion = assembled->motion_of(body->name, ""); !motion.is_identity())
            item->be_placed(motion);
      }
  }



  void
  Input::initialize_objects()
  {
    // in the order of the catalogue, so that what is referred to comes before what refers to it
    for (unsigned int i = 0; i < model.items.size(); ++i)
      {
        Item      &item   = *model.items[i];
        const auto before = model.complaints.count();
        model.scope       = scope_of(item.name);
        if (item.is_faulty)
          check_references(*outlines[i], model);
        else
          item.initialize(model);
        item.is_faulty = item.is_faulty || model.complaints.count() != before;
      }
    for (const auto &item : model.items)
      if (!item->is_faulty)
        {
          const auto before = model.complaints.count();
          model.scope       = scope_of(item->name);
          try
            {
              item->find_signals(model);
            }
          catch (const FollowUp &)
            {
              item->is_faulty = true;
            }
          item->is_faulty = item->is_faulty || model.complaints.count() != before;
        }
    model.scope.clear();
  }



  void
  Input::find_more_mistakes(Complaints &complaints)
  {
    const auto is_right     = [](const auto &c) { return !c->is_faulty; };
    const auto first_faulty = std::stable_partition(model.items.begin(), model.items.end(), is_right);
    const std::vector<std::unique_ptr<Item>> faulty(std::make_move_iterator(first_faulty),
                                                    std::make_move_iterator(model.items.end()));
    model.items.erase(first_faulty, model.items.end());
    try
      {
        const Layout layout(model);
      }
    catch (const InputError &error)
      {
        complaints.add_all(error.complaints);
      }
    find_probes(complaints);
  }



  namespace
  {
    /** A path with the body on which others are mounted in place of the name of its subsystem, before a dot or at the end. */
    std::string
    with_mounts(const std::string &path, const std::map<std::string, std::string> &mounts)
    {
      const std::string seen_from = " seen from ";
      const auto        seen      = path.rfind(seen_from);
      const auto        replaced  = [&](const std::string &part) {
        const auto dot   = part.find('.');
        const auto mount = mounts.find(trim(part.substr(0, dot)));
        return mount == mounts.end() ? part : mount->second + (dot == std::string::npos ? "" : part.substr(dot));
      };
      return seen == std::string::npos ?
               replaced(path) :
               replaced(path.substr(0, seen)) + seen_from + replaced(trim(path.substr(seen + seen_from.size())));
    }
  } // namespace



  void
  Input::add_probes_of(const Subsystems &subsystems)
  {
    if (!subsystems.mounts.empty() && !probes.empty())
      {
        for (auto &path : probes) // what is printed has no subsystems
          path = with_mounts(path, subsystems.mounts);
        root.subsection("Output").assign("Probes", probes);
      }
    for (const auto &[path, where] : subsystems.probes)
      {
        probes.push_back(path);
        places_of_probes[path] = where;
      }
    if (!subsystems.probes.empty())
      root.subsection("Output").assign("Probes", probes);
  }



  void
  Input::read_objects(const Group             &group,
                      const Subsystems::Scope &scope,
                      Subsystems              &subsystems,
                      Complaints              &complaints)
  {
    const Outline *const section = scope.outline->section(group.subsection);
    if (section == nullptr)
      return;
    for (const auto &entry : section->entries)
      complaints.add(entry.where, "<" + entry.name + "> stands outside of a named " + group.noun);
    for (const auto &said : section->sections)
      if (!scope.prefix.empty() || !subsystems.changes_another(group, said))
        read_object(group, scope, subsystems, subsystems.object(scope, group, said), complaints);
  }



  void
  Input::read_object(const Group             &group,
                     const Subsystems::Scope &scope,
                     const Subsystems        &subsystems,
                     const Outline           &object,
                     Complaints              &complaints)
  {
    const auto *const type = object.entry("Type");
    const std::string kind = type == nullptr ? group.usual_kind : type->value, name = scope.prefix + object.name;
    if ((kind.empty() && object.entry("Copy of") != nullptr) || subsystems.changes_nothing(group, object))
      {
        // there is a complaint about the original, or that there is none; or that there is nothing to change
        model.unmade.insert(name);
        return;
      }
    if (!group.kinds.contains(kind))
      {
        model.unmade.insert(name);
        complaints.add(type != nullptr ? type->where : object.where,
                       kind.empty() ?
                         group.noun + " <" + name + "> has no <Type>" + did_you_mean("", group.kinds.kinds()) :
                         "there is no " + group.noun + " of type <" + kind + ">" +
                           did_you_mean(kind, group.kinds.kinds()));
        return;
      }
    if (object.name.find('.') != std::string::npos)
      complaints.add(object.where, "a name must not contain a dot: it separates a body from its points");
    if (!scope.prefix.empty() && object.name.find(subsystem_separator) != std::string::npos)
      complaints.add(object.where,
                     "a name in a subsystem must not contain a colon: it separates a subsystem from its parts");
    auto item        = group.kinds.make(kind);
    item->name       = name;
    item->kind       = kind;
    item->subsection = group.subsection;
    item->parameters = Parameters(name, kind);
    item->add_parameters(item->parameters);
    const auto before = complaints.count();
    item->parameters.parse(object, scope.quantities, complaints);
    if (!scope.prefix.empty() && item->acts_on_whole_model())
      complaints.add(object.where,
                     kind + " <" + name + "> acts on the whole model: it stands there, and not in a subsystem");
    if (complaints.count() == before && !scope.placement.is_identity())
      try
        {
          item->be_placed(scope.placement);
        }
      catch (const std::invalid_argument &problem)
        {
          complaints.add(object.where, problem.what());
        }
    item->is_faulty = complaints.count() != before;
    model.items.push_back(std::move(item));
    subsections.push_back(group.subsection);
    outlines.push_back(&object);
  }
} // namespace samara
