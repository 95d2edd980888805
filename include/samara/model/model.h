#ifndef samara_model_model_h
#define samara_model_model_h

#include <samara/base/errors.h>
#include <samara/base/text.h>
#include <samara/model/frame.h>
#include <samara/model/item.h>

#include <map>
#include <memory>
#include <unordered_map>
#include <unordered_set>

namespace samara
{
  struct FrameMotion;

  /** A piece of a body along which loads act: everything on it is a polynomial through its frames. */
  struct Span
  {
    std::vector<Frame>  frames;
    std::vector<double> abscissae;  ///< of the frames: arc length from the body's start [m]
    double              start, end; ///< of the piece [m]
  };



  /** An item that others can be attached to. */
  class Body : public Item
  {
  public:
    /**
     * The frame of a named point ("start", "end", "middle", "centre" or one the user has named).
     * @throws std::invalid_argument naming the points there are.
     */
    virtual Frame frame(const std::string &point) const = 0;

    virtual std::vector<std::string> points() const = 0;

    /** Quantities of a point, see frame_signal(): "tip.velocity y". */
    std::shared_ptr<Signal> signal(Model &model, const std::string &path) override;

    /** Pieces along which loads per length are applied; empty for a body without extent. */
    virtual std::vector<Span>
    spans() const
    {
      return {};
    }
  };



  /**
   * What a model is made of before it is solved: nodes with their inertia, welds between them, joint coordinates, and
   * the items that own all of these. Node 0 is the ground.
   */
  class Model
  {
  public:
    struct Node
    {
      std::string name;
      Vector3     x;       ///< reference position [m]
      Matrix3     D;       ///< reference triad
      Matrix6     inertia; ///< in the node's frame: [m I, −m c~; m c~, J], J about the node [kg, kg m, kg m²]
    };

    Model();

    /** @name Building @{ */
    Frame ground() const;
    Frame add_node(const std::string &name, const Vector3 &x, const Matrix3 &D);

    /** Add the inertia @p M seen in @p frame to its node. */
    void add_inertia(const Frame &frame, const Matrix6 &M);

    /** Let two frames keep their relative position and orientation of the reference configuration. */
    void weld(const Frame &a, const Frame &b);

    /** A scalar unknown of a joint; @p unit is "m" or "rad". Returns its number. */
    unsigned int add_coordinate(const std::string &name, const std::string &unit);

    /** A state of first order, its start and the size that matters to it [its unit]. Returns its number. */
    unsigned int add_state(const std::string &name, const std::string &unit, double initial, double scale);

    /** Merge welded nodes. Afterwards frames must be taken through resolved(). */
    void close();
    /** @} */

    /** The same frame attached to the node that is left after merging. */
    Frame resolved(const Frame &frame) const;

    /** Reference position and triad of a frame. */
    Vector3 position(const Frame &frame) const;
    Matrix3 triad(const Frame &frame) const;

    /** The frame at the reference position @p x with reference axes @p D, rigidly attached to @p frame. */
    Frame frame_at(const Frame &frame, const Vector3 &x, const Matrix3 &D) const;

    /** A frame by its path: "ground", "shaft 1.start". @throws std::invalid_argument saying what is known. */
    Frame frame(const std::string &path) const;

    /** Whether there is an item of that full name. */
    bool
    is_item(const std::string &full_name) const
    {
      return !named(full_name).empty();
    }

    /** An item by name, as the type that is wanted. @throws std::invalid_argument, FollowUp if it is faulty */
    template <typename Kind>
    Kind &find(const std::string &name, const std::string &noun) const;

    /**
     * Make a joint's rotation an unknown, "hinge.rotation", or "hinge" if it has only one, and return the number of the
     * coordinate. @throws std::invalid_argument saying what rotations there are.
     */
    unsigned int use_rotation(const std::string &path);

    /** The signal "shaft 1.middle.displacement y", or that of a state. @throws std::invalid_argument, FollowUp */
    std::shared_ptr<Signal> signal(const std::string &path);

    /** The probe "shaft 1.middle.displacement y". @throws std::invalid_argument */
    Probe probe(const std::string &path) const;

    /**
     * A steady rotation that the model is in: as a whole, ground included, about an axis; or a part of it, whatever is
     * carried along when the coordinate of a joint turns at the given speed.
     */
    struct Rotation
    {
      std::string name;
      double      speed      = 0;  ///< [rad/s]
      int         coordinate = -1; ///< of the joint; negative: the whole model turns
      Vector3     axis = Vector3::UnitZ(), through = Vector3::Zero();
    };
    std::vector<Rotation> rotations;

    std::vector<std::unique_ptr<Item>> items;
    std::vector<Node>                  nodes; ///< after close(): those that are left
    std::vector<std::string>           coordinates, coordinate_units;

    struct StateOfFirstOrder
    {
      std::string name, unit;
      double      initial, scale;

      /** Whether it has no rate, 0 = g(q, y, z, t) in place of ż = g: it follows at once. Its item says so. */
      bool is_algebraic = false;
    };
    std::vector<StateOfFirstOrder> states;

    /** The multiplier that keeps the angle of each rotation at a joint: the rotation's own, or a prescribed one. */
    std::vector<unsigned int> holds;

    /** Coordinates that are changes of a length, and the length that they change [m], which stays above zero: where
     * l² is the square of a distance, −l is a root that no motion has. Known when joints are connected. */
    std::map<unsigned int, double> lengths;

    /** A coordinate whose length these values would make negative; −1 if there is none. */
    int negative_length(const std::vector<double> &values) const;

    /** The multipliers of prescribed coordinates, by coordinate; known when joints are connected. */
    std::map<unsigned int, unsigned int> prescribed;

    /** Whether laws name a state that is no control: it may bring a speed back. Known when signals are found. */
    bool laws_name_states = false;

    Complaints complaints;

    /**
     * The subsystem from which names are looked up, "rotor:blade 1:", or "": first those in it, "rotor:blade 1:flap",
     * then those around it, "rotor:flap", then "flap". A name with a colon in front, ":flap", is one of the model.
     */
    std::string scope;

    /** Names of what could not even be constructed; there is a complaint about each. */
    std::unordered_set<std::string> unmade;

    /** Full names of objects that are left out, and where that is said; of all in a subsystem it is "blade:". */
    std::map<std::string, std::string> inactive;

    /** What "hub" stands for where that is the name of a subsystem: the body in it on which others are mounted,
     * "hub:hub". */
    std::map<std::string, std::string> mounts;

  private:
    /** What a name stands for: of a subsystem with a mount that is no object itself the mount. */
    std::string mounted(const std::string &name) const;

    /** The probe of a point as a body sees it, "blade.end.position z" of "blade.end.position z seen from hub". */
    Probe probe_seen_from(const std::string &path, const std::string &observer) const;

    /** A frame after close(), its motion as that of the state. */
    std::function<FrameMotion(const State &)> motion_of(const Frame &frame) const;

    /** Where it is said that an object is left out; "" of one that is not. */
    std::string where_inactive(const std::string &full_name) const;

    /** All items of that full name, in their order. Items are added, and never taken away nor renamed. */
    const std::vector<Item *> &named(const std::string &name) const;

    /** The full names that @p name may stand for, see `scope`. */
    std::vector<std::string> full_names(const std::string &name) const;

    /** Complains about a name that find() has not found. @throws std::invalid_argument, FollowUp */
    [[noreturn]] void
    refuse(const std::string &name, const std::string &noun, const std::vector<const Item *> &others) const;

    std::vector<Frame> parent;  // of every node that was added: a frame on the node it is welded to, or itself
    std::vector<int>   kept_as; // number of a root among the nodes that are left
    Frame              root_of(const Frame &frame) const;

    mutable std::unordered_map<std::string, std::vector<Item *>> items_by_name;
    mutable std::size_t                                          n_indexed = 0; ///< items in it
  };



  template <typename Kind>
  Kind &
  Model::find(const std::string &name, const std::string &noun) const
  {
    for (const auto &full_name : full_names(name))
      {
        for (auto *const c : named(full_name))
          if (auto *const wanted = dynamic_cast<Kind *>(c))
            {
              if (c->is_faulty)
                throw FollowUp();
              return *wanted;
            }
        if (unmade.count(full_name) > 0)
          throw FollowUp();
      }
    std::vector<const Item *> others;
    if (may_suggest())
      for (const auto &c : items)
        if (dynamic_cast<Kind *>(c.get()) != nullptr)
          others.push_back(c.get());
    refuse(name, noun, others);
  }



  /** What stands between the name of a subsystem and those of the objects in it: "blade 1:flap". */
  constexpr char subsystem_separator = ':';

  /** The subsystem of an object with this full name: "rotor:blade 1:" of "rotor:blade 1:flap"; empty in none. */
  std::string scope_of(const std::string &full_name);

  /** Diagonal of the box around the reference positions of all nodes there are [m]. */
  double box_diagonal(const Model &model);
} // namespace samara

#endif
