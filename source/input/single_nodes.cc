#include <samara/base/outline.h>
#include <samara/base/text.h>
#include <samara/cosserat/shell.h>
#include <samara/input/single_nodes.h>
#include <samara/joints/flexible_joint.h>
#include <samara/joints/joint.h>
#include <samara/loads/loads.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace samara
{
  namespace
  {
    /** Kinds of joints that leave all rotations free, or act along a line: forces alone. */
    const std::set<std::string> joints_of_forces = {"spherical",
                                                    "spring",
                                                    "distance",
                                                    "in line",
                                                    "in plane",
                                                    "point on curve",
                                                    "sliding point",
                                                    "rolling ball",
                                                    "ball on plane",
                                                    "ball on ball",
                                                    "ball on cylinder",
                                                    "ellipsoid on plane"};

    /** What an item gives to the points of its entries; nothing if it is neither a joint nor a load at a point. */
    enum class Given
    {
      nothing,
      force,
      moment
    };

    Given
    given_by(const Item &item)
    {
      if (dynamic_cast<const ConcentratedLoad *>(&item) != nullptr)
        return item.parameters.is_set("Moment") ? Given::moment : Given::force;
      if (dynamic_cast<const Joint *>(&item) == nullptr && dynamic_cast<const FlexibleJoint *>(&item) == nullptr)
        return Given::nothing;
      return joints_of_forces.count(item.kind) > 0 ? Given::force : Given::moment;
    }

    /** The points an item names. */
    std::vector<std::string>
    places_of(const Item &item)
    {
      std::ostringstream said;
      item.parameters.print(said);
      Complaints               none;
      const Outline            entries = Outline::of_text(said.str(), item.name, none);
      std::vector<std::string> places;
      for (const std::string entry : {"Body A", "Body B", "At"})
        if (const std::string place = entries.value(entry); !place.empty())
          places.push_back(place);
      return places;
    }

    /** The shell of such a name, looked up from the subsystem of an item. */
    const Shell *
    shell_named(const Model &model, const std::string &item, const std::string &name)
    {
      for (std::string scope = scope_of(item);; scope = scope_of(scope.substr(0, scope.size() - 1)))
        {
          for (const auto &other : model.items)
            if (const auto *const shell = dynamic_cast<const Shell *>(other.get()))
              if (shell->name == scope + name)
                return shell;
          if (scope.empty())
            return nullptr;
        }
    }
  } // namespace



  std::vector<std::string>
  loads_at_single_nodes(const Model &model)
  {
    std::vector<std::string> warnings;
    if (std::none_of(model.items.begin(), model.items.end(), [](const auto &item) {
          return dynamic_cast<const Shell *>(item.get()) != nullptr;
        }))
      return warnings;
    for (const auto &item : model.items)
      if (const Given given = given_by(*item); given != Given::nothing)
        for (const std::string &path : places_of(*item))
          {
            const auto         dot = path.find('.');
            const Shell *const shell =
              dot == std::string::npos ? nullptr : shell_named(model, item->name, trim(path.substr(0, dot)));
            if (shell == nullptr || !shell->is_single_node(trim(path.substr(dot + 1))))
              continue;
            const bool is_moment = given == Given::moment;
            warnings.push_back(
              item->parameters.where() + ": <" + item->name + "> gives a " + (is_moment ? "moment" : "force") +
              " to a single node, <" + path + ">: " +
              (is_moment ? "the rotation of a shell there has no limit as its elements get smaller, and results "
                           "depend on the mesh. " :
                           "the deflection of a shell there grows with the logarithm of the number of its elements, "
                           "which matters where these are smaller than it is thick. ") +
              "Attach it to one of the <Rigid edges> of the shell, or to edges by a joint of type distributing");
          }
    return warnings;
  }
} // namespace samara
