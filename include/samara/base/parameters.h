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
     * then keeps its value. `Type` and `Copy of` are skipped unless they were added.
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

    /** What the entries of all objects of a kind have in common: there may be many objects, and it is kept once. */
    struct Declaration
    {
      std::string              name, documentation, unit;
      std::unique_ptr<Pattern> pattern;
    };

    /** What declares an entry; @p identity is as different as patterns are, and the pattern is made when it is new. */
    struct Wanted
    {
      const std::string                               &name, &documentation;
      bool                                             has_unit;
      std::string                                      identity;
      const std::function<std::unique_ptr<Pattern>()> &pattern;
    };

    struct Entry
    {
      const Declaration           *declaration;
      std::string                  value; ///< in SI units
      std::unique_ptr<std::string> where; ///< of most entries the file says nothing
      void                        *variable;

      /** Make SI text from the user's, refuse it or write the variable. */
      std::string (*read)(const std::string &text, const Quantities &, const Entry &);

      /** Write the variable that is meant in the axes of @p placement, and return its text; null if it has no axes. */
      std::string (*place)(const Entry &, const Placement &placement, bool is_position) = nullptr;
      Turning turning     = Turning::unknown;
      bool    is_assigned = false; ///< the value is not, or not only, what the file says

      /** Of an entry whose unit is only known when it is read; null otherwise. */
      const std::function<std::string(const Quantities &)> *unit_when_read = nullptr;

      const std::string &
      name() const
      {
        return declaration->name;
      }
    };

    /** That of all entries like it. It lives as long as the program. */
    static const Declaration &declaration_of(const Wanted &wanted);

    /** Throws std::invalid_argument if the pattern does not match. */
    static void check_pattern(const std::string &users_text, const std::string &si_text, const Entry &entry);

    template <typename T>
    static std::string read_value(const std::string &text, const Quantities &quantities, const Entry &entry);

    template <typename T>
    static std::string place_value(const Entry &entry, const Placement &placement, bool is_position);

    template <typename T>
    void declare(T &variable, const Wanted &wanted);

    void declare(Entry entry);

    /** With @p is_copy, mistakes in what is inherited are left to the original, which is of the same kind. */
    void parse(const Outline &section, const Quantities &quantities, Complaints &complaints, bool is_copy);

    void read_entry(Entry &entry, const Outline::Entry &given, const Quantities &quantities, Complaints &complaints);

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
    std::vector<std::shared_ptr<const std::function<std::string(const Quantities &)>>> units_when_read;
    std::string                              step; ///< name of this subsection in the one around it
  };



  template <typename T>
  std::string
  Parameters::read_value(const std::string &text, const Quantities &quantities, const Entry &entry)
  {
    T                 value   = Value<T>::read(text,
                             entry.unit_when_read ? (*entry.unit_when_read)(quantities) : entry.declaration->unit,
                             quantities);
    const std::string si_text = Value<T>::write(value);
    check_pattern(text, si_text, entry);
    *static_cast<T *>(entry.variable) = std::move(value);
    return si_text;
  }



  template <typename T>
  void
  Parameters::declare(T &variable, const Wanted &wanted)
  {
    Entry entry{&declaration_of(wanted), Value<T>::write(variable), nullptr, &variable, &read_value<T>};
    if constexpr (Placed<T>::is_spatial)
      entry.place = &place_value<T>;
    declare(std::move(entry));
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
    Entry &entry                       = existing(name);
    *static_cast<T *>(entry.variable) = value;
    entry.value                        = Value<T>::write(value);
    entry.is_assigned                  = true;
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
