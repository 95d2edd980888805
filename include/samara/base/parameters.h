#ifndef samara_base_parameters_h
#define samara_base_parameters_h

#include <samara/base/errors.h>
#include <samara/base/outline.h>
#include <samara/base/placed.h>
#include <samara/base/quantity.h>
#include <samara/base/value.h>

#include <deal.II/base/patterns.h>

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <typeinfo>
#include <vector>

namespace samara
{
  /**
   * The entries which one object has in its subsection of a .prm file, bound to its variables.
   *
   * An object declares each entry once with add(); there is no twin function that parses. parse() reads what the
   * Outline has, with units and constants, checks it by the patterns of dealii::Patterns, and writes the
   * variables, which must stay where they are until then. A variable of which the file says nothing keeps its value.
   *
   * The unit of a number is what stands in the last brackets of its documentation, "Mass [kg].". Numbers without
   * brackets, or with [1] or [-], have no unit. Only SI units can be declared.
   */
  class Parameters
  {
  public:
    /** @p name and @p kind of the object, "hub" and "rigid body", are for complaints. */
    explicit Parameters(const std::string &name = "", const std::string &kind = "");

    /** Bind the entry @p name to @p variable, whose present value is the default. */
    template <typename T>
    void add(const std::string &name, T &variable, const std::string &documentation);

    /** The same with what must hold of its value, instead of Value<T>::pattern(). */
    template <typename T>
    void add(const std::string                   &name,
             T                                   &variable,
             const std::string                   &documentation,
             const dealii::Patterns::PatternBase &pattern);

    /** The same for the name of a file, which is relative to the file that says it. */
    void add_file(const std::string &name, std::string &variable, const std::string &documentation);

    /** The unit of an entry that was added is only known when it is read, from @p unit. */
    void take_unit(const std::string &name, const std::function<std::string(const Quantities &)> &unit);

    /**
     * What becomes of an entry with three components in space when the axes turn in which it is given. Every such entry
     * of an object that may stand in a subsystem says it; own_axes is an answer, too.
     */
    void turns(const std::string &name, Turning turning);

    /**
     * Take what turns to the axes of the model; to be called once, after parse().
     * @throws std::invalid_argument if an entry does not say how it turns: its kind cannot stand in a subsystem.
     */
    void be_placed(const Placement &placement);

    /** Give the bound variable of an entry another value, and print it as if the file had said so. */
    template <typename T>
    void assign(const std::string &name, const T &value);

    /** The entries of the nested subsection @p name; a new one at the first call. */
    Parameters &subsection(const std::string &name);

    /** There may be a nested subsection of this name, which somebody else reads. */
    void ignore_subsection(const std::string &name);

    /**
     * Read @p section into the variables. Everything that is wrong or not known goes to @p complaints; the variable
     * then keeps its value. `Type`, `Copy of` and `Active` are skipped unless they were added. An entry that is `none`
     * counts as not given, unless that is one of its choices.
     */
    void parse(const Outline &section, const Quantities &quantities, Complaints &complaints);

    /** Whether there is an entry of this name. */
    bool has(const std::string &name) const;

    /** Whether the file said something about the entry. */
    bool is_set(const std::string &name) const;

    /** "file:line" of the entry; of the subsection if the entry was not given. */
    std::string where(const std::string &name) const;

    /** "file:line" of the subsection. */
    const std::string &where() const;

    /** Complain if the entry was not given, or is empty; returns whether it was given. */
    bool require(const std::string &name, Complaints &complaints) const;

    /**
     * All values in SI units, as they are used, in the format of a .prm file; nested subsections among them, every line
     * behind @p indent. What the file did not say stands in comments, so that it is not said when this is read again.
     */
    void print(std::ostream &out, const std::string &indent = "") const;

    /** A Markdown table of all entries, to be asked before anything is read: values are the defaults. */
    void document(std::ostream &out) const;

  private:
    using Pattern = dealii::Patterns::PatternBase;

    struct Entry;

    /** Make SI text from the user's, refuse it or write the variable. */
    using Read = std::string (*)(const std::string &text, const Quantities &, const Entry &, const std::string &unit);

    /** Write the variable that is meant in the axes of @p placement, and return its text. */
    using Place = std::string (*)(const Entry &, const Placement &placement, bool is_position);

    /** What the entries of all objects of a kind have in common: there may be many objects, and it is kept once. */
    struct Declaration
    {
      std::string              name, documentation, unit;
      std::string              standard; ///< the default, in SI units
      std::unique_ptr<Pattern> pattern;
      Read                     read;
      Place                    place; ///< null of what has no axes
    };

    /** What declares an entry; @p identity is as different as patterns are, and the pattern is made when it is new. */
    struct Wanted
    {
      const std::string                               &name, &documentation;
      bool                                             has_unit;
      std::string                                      identity;
      const std::function<std::unique_ptr<Pattern>()> &pattern;
      std::string                                      standard = "";
      Read                                             read     = nullptr;
      Place                                            place    = nullptr;
    };

    /** A value that is not the default. */
    struct Said
    {
      std::string value;   ///< in SI units
      std::string where;   ///< "file:line"
      bool        is_read; ///< in the file or the command line; otherwise the program found another value
    };

    /** One of many: most objects leave most of their entries as they are. */
    struct Entry
    {
      const Declaration    *declaration;
      void                 *variable;
      std::unique_ptr<Said> said    = nullptr;
      Turning               turning = Turning::unknown;

      const std::string &
      name() const
      {
        return declaration->name;
      }

      const std::string &
      value() const
      {
        return said ? said->value : declaration->standard;
      }

      bool
      is_read() const
      {
        return said && said->is_read;
      }

      /** The program found another value than the one that was read, or than the default. */
      void assign(const std::string &value);
    };

    /** That of all entries like it. It lives as long as the program. */
    static const Declaration &declaration_of(const Wanted &wanted);

    /** Throws std::invalid_argument if the pattern does not match. */
    static void check_pattern(const std::string &users_text, const std::string &si_text, const Entry &entry);

    template <typename T>
    static std::string
    read_value(const std::string &text, const Quantities &quantities, const Entry &entry, const std::string &unit);

    template <typename T>
    static std::string place_value(const Entry &entry, const Placement &placement, bool is_position);

    template <typename T>
    void declare(T &variable, Wanted wanted);

    void declare(void *variable, const Wanted &wanted);

    /** With @p is_copy, mistakes in what is inherited are left to the original, which is of the same kind. */
    void parse(const Outline &section, const Quantities &quantities, Complaints &complaints, bool is_copy);

    void read_entry(Entry &entry, const Outline::Entry &given, const Quantities &quantities, Complaints &complaints);

    /** In which numbers without a unit are meant. */
    std::string unit_when_read(const Entry &entry, const Quantities &quantities) const;

    void complain_about_entry(const Outline::Entry &given, Complaints &complaints) const;

    void complain_about_subsection(const Outline &given, Complaints &complaints) const;

    void set_place(const std::string &where);

    void document_rows(const std::string &prefix, std::ostream &out) const;

    const Entry &existing(const std::string &name) const;

    Entry &existing(const std::string &name);

    /** "<hub> (rigid body)" */
    std::string description() const;

    std::string                              name;
    std::string                              kind;
    std::string                              place;
    std::vector<Entry>                       entries;
    std::vector<std::unique_ptr<Parameters>> subsections;
    std::vector<std::string>                 ignored;
    std::string                              step; ///< name of this subsection in the one around it

    /** Of entries whose unit is only known when they are read. */
    std::vector<std::pair<const Declaration *, std::function<std::string(const Quantities &)>>> units_when_read;
  };



  template <typename T>
  std::string
  Parameters::read_value(const std::string &text,
                         const Quantities  &quantities,
                         const Entry       &entry,
                         const std::string &unit)
  {
    T                 value   = Value<T>::read(text, unit, quantities);
    const std::string si_text = Value<T>::write(value);
    check_pattern(text, si_text, entry);
    *static_cast<T *>(entry.variable) = std::move(value);
    return si_text;
  }



  template <typename T>
  void
  Parameters::declare(T &variable, Wanted wanted)
  {
    wanted.standard = Value<T>::write(variable);
    if (!wanted.read)
      wanted.read = &read_value<T>;
    if constexpr (Placed<T>::is_spatial)
      wanted.place = &place_value<T>;
    declare(&variable, wanted);
  }



  template <typename T>
  std::string
  Parameters::place_value(const Entry &entry, const Placement &placement, const bool is_position)
  {
    T &variable = *static_cast<T *>(entry.variable);
    if constexpr (Placed<T>::is_spatial)
      variable = Placed<T>::of(variable, placement, is_position);
    return Value<T>::write(variable);
  }



  template <typename T>
  void
  Parameters::assign(const std::string &name, const T &value)
  {
    Entry &entry                      = existing(name);
    *static_cast<T *>(entry.variable) = value;
    entry.assign(Value<T>::write(value));
  }



  template <typename T>
  void
  Parameters::add(const std::string &name, T &variable, const std::string &documentation)
  {
    static const std::function<std::unique_ptr<Pattern>()> pattern = [] { return Value<T>::pattern(); };
    declare(variable, {name, documentation, Value<T>::has_unit, typeid(T).name(), pattern});
  }



  template <typename T>
  void
  Parameters::add(const std::string                   &name,
                  T                                   &variable,
                  const std::string                   &documentation,
                  const dealii::Patterns::PatternBase &pattern)
  {
    declare(variable, {name, documentation, Value<T>::has_unit, pattern.description(Pattern::Machine), [&] {
                         return pattern.clone();
                       }});
  }
} // namespace samara

#endif
