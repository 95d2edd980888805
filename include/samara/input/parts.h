#ifndef samara_input_parts_h
#define samara_input_parts_h

#include <samara/base/outline.h>

#include <string>
#include <vector>

namespace samara
{
  /**
   * What is asked of who uses a part, one subsection of its `subsection Arguments`:
   *
   *     subsection Flap hinge
   *       set Kind    = number
   *       set Unit    = m
   *       set Default = 0.3 m          # left out: it must be given; none: it need not
   *       set Meaning = Distance of the flap hinge from the axis.
   *     end
   *
   * In the part it is the constant `flap_hinge`, or the text `${flap_hinge}`; `has_flap_hinge` is 1 if there is one.
   */
  struct PartArgument
  {
    std::string              name, kind = "number", unit = "1", standard, meaning, where;
    std::vector<std::string> choices;
    bool                     is_required = false;

    /** "Flap hinge": "flap_hinge" */
    std::string word() const;

    /** A sentence with unit, default and choices, as entries have it. */
    std::string documentation() const;
  };

  /** A word that names can have in expressions: small letters, and _ for what is none. */
  std::string word_of(const std::string &name);

  /** What the subsection Arguments of a part says. */
  std::vector<PartArgument> arguments_of(const Outline &section, Complaints &complaints);

  /** The folder of the parts that come with the program, found beside or above it; "" if there is none. */
  std::string folder_of_parts();

  /** Names of these parts, "rotor/hub". */
  std::vector<std::string> shipped_parts();

  /**
   * The file of a part: beside the file that asks for it, or one that comes with the program.
   * @throws std::invalid_argument with the nearest part there is
   */
  std::string file_of_part(const std::string &name, const std::string &asking_file);

  /** The comment at the head of a file, without the signs of comments. */
  std::string head_of_file(const std::string &file);

  /** Put what each `Part` contains into the subsystem that asks for it; what that says has the last word. */
  void expand_parts(Outline &model, Complaints &complaints);
} // namespace samara

#endif
