#ifndef samara_model_item_h
#define samara_model_item_h

#include <samara/base/parameters.h>
#include <samara/model/drawing.h>
#include <samara/model/state.h>

#include <functional>
#include <memory>
#include <optional>

namespace samara
{
  class Model;
  class Layout;
  class Signal;

  /** A number that can be asked of a state: a column of the histories. */
  struct Probe
  {
    std::string                          name, unit;
    std::function<double(const State &)> value;
  };



  /**
   * A named thing of the input file: a body, a joint, a load, a section. An item adds nodes, coordinates and terms to
   * the model; what is computed is in its terms (terms.h). A section, or a weld, is an item without terms.
   *
   * Its life: construct → add_parameters() → (parse) → (be_placed) → initialize() → connect(). Afterwards it is constant: all that
   * changes is in the State.
   */
  class Item
  {
  public:
    virtual ~Item() = default;

    std::string name, kind;
    std::string subsection; ///< of the file that it stands in, "Bodies"
    Parameters  parameters;

    /** What messages call such a thing, "joint", "gear"; "" where its name says enough. */
    virtual std::string
    noun() const
    {
      return "";
    }

    /** "joint hinge", "gear train": for people alone. A noun with which the name begins is not said twice. */
    std::string
    title() const
    {
      const std::string with_blank = noun() + " ";
      return with_blank.size() == 1 || name.compare(0, with_blank.size(), with_blank) == 0 ? name : with_blank + name;
    }

    /** There has been a complaint about it: it is not initialized, or not to its end, and must not be used. */
    bool is_faulty = false;

    /** Bind every entry this kind has in the input file to a variable. */
    virtual void
    add_parameters(Parameters &)
    {}

    /**
     * Take what has been read in the axes of a subsystem to those of the model. Entries with three components say
     * themselves how they turn, see Parameters::turns(); an item overrides this for what it reads or chooses by other means.
     * @throws std::invalid_argument
     */
    virtual void
    be_placed(const Placement &placement)
    {
      parameters.be_placed(placement);
    }

    /** Whether it acts on all bodies there are: then it cannot stand in a subsystem. */
    virtual bool
    acts_on_whole_model() const
    {
      return false;
    }

    /** Whether the state that it adds is a control, which keeps its value: no law of the model brings it back. */
    virtual bool
    is_control() const
    {
      return false;
    }

    /** Turn names into references, check values, add nodes and welds. Complaints go to the model. */
    virtual void initialize(Model &model) = 0;

    /**
     * Make a relative motion ("rotation", "displacement"; "" if there is only one) an unknown and return its number
     * among the model's coordinates; nothing if there is no such motion. To be called from initialize().
     */
    virtual std::optional<unsigned int>
    use_coordinate(Model &, const std::string & /*motion*/)
    {
      return {};
    }

    /** The relative motions among these that are rotations. */
    virtual std::vector<std::string>
    rotation_names() const
    {
      return {};
    }

    /** Find the signals that the item's laws depend on; to be called when all items are initialized. */
    virtual void
    find_signals(Model &)
    {}

    /** The signal for a path such as "tip.velocity y", in SI units; null if there is no such thing. */
    virtual std::shared_ptr<Signal>
    signal(Model &, const std::string &)
    {
      return nullptr;
    }

    /** Take numbers for multipliers, say which unknowns are coupled, and add the terms. */
    virtual void
    connect(Layout &)
    {}

    /** Add what the user says of this item's velocities at the start to the twists of its nodes. */
    virtual void
    add_initial_velocities(State &) const
    {}

    /** The probe for a path such as "middle.displacement y"; nothing if there is no such thing. */
    virtual std::optional<Probe>
    probe(const std::string &) const
    {
      return {};
    }

    /** What probe() understands, for messages and the documentation. */
    virtual std::vector<std::string>
    probe_names() const
    {
      return {};
    }

    virtual void
    draw(const State &, Drawing &) const
    {}

    /** Where the mesh is too coarse for this state and why, for a warning; empty if it is fine enough. */
    virtual std::string
    coarse_place(const State &) const
    {
      return {};
    }
  };
} // namespace samara

#endif
