#ifndef samara_input_subsystems_h
#define samara_input_subsystems_h

#include <samara/base/parameters.h>
#include <samara/input/catalogue.h>
#include <samara/input/parts.h>

#include <deque>
#include <map>
#include <set>

namespace samara
{
  /** The entries of a subsystem, beside the subsections that a model has, too. */
  struct SubsystemEntries
  {
    std::string              copies, part, active = "true";
    std::vector<std::string> arguments;
    Eigen::Vector3d          position = Eigen::Vector3d::Zero(), rotation = Eigen::Vector3d::Zero();
    std::string              sequence = "321";

    void add_parameters(Parameters &prm);
  };



  /**
   * The objects of a model with its subsystems, one copy of a subsystem after the other: what they are called, how
   * their numbers and names are read, and where they stand.
   *
   *     subsection Subsystems
   *       subsection blade
   *         include blade.prm
   *         set Copies    = 4 about z
   *         set Arguments = length = 7 m
   *       end
   *     end
   *
   * Objects of copy 2 are called "blade 2:flap"; without `Copies` it is "blade:flap". What the model itself says in its
   * subsection Bodies of a "blade 2:flap" changes that copy.
   */
  class Subsystems
  {
  public:
    /** A model, or a copy of a subsystem: a scope of names. */
    struct Scope
    {
      std::string    prefix; ///< of its names, "rotor:blade 2:"; empty for the model itself
      const Outline *outline;
      Placement      placement;
      Quantities     quantities;
      const Scope   *around = nullptr;
      std::string    twin;    ///< prefix of the first copy, which has the same mistakes
      bool           is_copy; ///< it, or one around it, is a `Copy of` another

      bool is_faulty = false; ///< its arguments are wrong: nothing is made of it, and what follows is not told

      /** An argument that is a law: read when it is known what laws may name. */
      struct LawArgument
      {
        std::string word, text, unit, where;
        bool        is_given; ///< or it is the default, which the part itself understands
      };
      std::vector<LawArgument> laws = {};

      /** Of a part: what its own text knows, which the constants of who uses it do not change; and its file. */
      std::shared_ptr<Quantities> own      = nullptr;
      std::string                 own_file = "";
    };

    /** @p quantities knows the constants of the model. Must live as long as the outlines are used. */
    Subsystems(const Catalogue &catalogue, const Outline &model, const Quantities &quantities, Complaints &complaints);

    /** The model itself first. */
    const std::deque<Scope> &
    scopes() const
    {
      return all;
    }

    /** What is said of an object of a group; of one in a subsystem with what the model changes in it. */
    const Outline &object(const Scope &scope, const Group &group, const Outline &said);

    /** Whether the model says this of an object in a subsystem; then it makes none itself. */
    bool changes_another(const Group &group, const Outline &said) const;

    /** Whether it has the name of an object in a subsystem, where there is none, and no type of its own. */
    bool changes_nothing(const Group &group, const Outline &said) const;

    /** Probes that subsystems ask for: full paths, and where they stand. */
    std::vector<std::pair<std::string, std::string>> probes;

    /** Objects and subsystems that are left out, see Model::inactive. */
    std::map<std::string, std::string> inactive;

    /** Objects of parts whose arguments are wrong, see Model::unmade. */
    std::set<std::string> unmade;

    /** See Model::mounts. */
    std::map<std::string, std::string> mounts;

    /** Take the texts that "${name}" stands for into all entries but those of subsystems. */
    static void put_texts(Outline &outline, const Quantities &quantities, Complaints &complaints);

    /** Complaints that copies have in common with the first copy, once. */
    Complaints without_twins(const Complaints &complaints) const;

  private:
    using Key = std::pair<std::string, std::string>; ///< group and full name

    const Catalogue               &catalogue;
    std::deque<Scope>              all;
    std::map<Key, const Outline *> objects; ///< in subsystems
    std::deque<Outline>            changed, rewritten;
    std::set<std::string>          prefixes;

    /** What is said of a subsystem, as it is read. */
    struct Reading
    {
      SubsystemEntries          entries;
      Parameters                parameters;
      std::vector<PartArgument> wanted;
      std::vector<std::string>  given;
      std::size_t               before = 0; ///< complaints before it was read
      std::string               first;      ///< prefix of the first copy; empty as long as there is none
      Placement                 placed;
    };

    void expand(const Scope &around, Complaints &complaints);
    void read(Reading &reading, const Scope &around, const Outline &said, Complaints &complaints) const;
    void find_first(Reading &reading, const Scope &around, const Outline &said) const;
    bool make_copy(Reading         &reading,
                   const Scope     &around,
                   const Outline   &said,
                   const Placement &of_copy,
                   unsigned int     k,
                   unsigned int     n,
                   Complaints      &complaints);
    void make_copies(const Scope &around, const Outline &said, Complaints &complaints);
    void read_constants(Scope                          &scope,
                        const std::vector<std::string> &arguments,
                        const std::string              &where,
                        Complaints                     &complaints) const;
    void give_arguments(Scope         &scope,
                        const Outline &said,
                        const Reading &reading,
                        unsigned int   k,
                        unsigned int   n,
                        Complaints    &complaints);
    void
    give_argument(Scope &scope, const Outline &said, const Reading &reading, std::size_t i, Complaints &complaints);
    void give_same(Scope              &scope,
                   const PartArgument &argument,
                   const std::string  &default_text,
                   Complaints         &complaints) const;
    void give_place(Scope &scope, const PartArgument &argument, const std::string &text) const;
    void read_laws(Complaints &complaints);
    void rewrite(Complaints &complaints);
    bool is_active(const Scope &scope, const Group &group, const Outline &said, Complaints &complaints);
    void add_signals(Complaints &complaints);
    void add_probes(const Scope &scope, Complaints &complaints);
    void check_changes(Complaints &complaints) const;
  };

} // namespace samara

#endif
