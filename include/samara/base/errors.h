#ifndef samara_base_errors_h
#define samara_base_errors_h

#include <map>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <vector>

namespace samara
{
  /** What the program returns to the shell. */
  enum ExitCode
  {
    success        = 0,
    input_error    = 2,
    not_converged  = 3,
    internal_error = 4,
    interrupted    = 130 ///< by the user
  };



  /**
   * The user's input cannot be accepted. Carries all that is wrong with it at once, one complaint a line, each with its
   * place, so that a model is repaired in one go and not in a dialogue.
   */
  class InputError : public std::runtime_error
  {
  public:
    explicit InputError(const std::string &complaint);
    explicit InputError(const std::vector<std::string> &complaints);

    const std::vector<std::string> complaints;
  };



  /** These complaints, with @p where in front of those that do not say "file:line". */
  std::vector<std::string> with_place(const std::vector<std::string> &complaints, const std::string &where);



  /** The input makes sense, but the computation did not arrive; what() says where it stopped. */
  class NotConverged : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };



  /** A file of the results cannot be written: a full disk, a folder of somebody else. */
  class CannotWrite : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };



  /**
   * What is wrong follows from a mistake elsewhere, about which there is a complaint: nothing more is to be said.
   * Thrown where a name belongs to something that could not be made; complaining about it counts, but has no words.
   */
  class FollowUp : public std::invalid_argument
  {
  public:
    FollowUp()
      : std::invalid_argument("")
    {}
  };



  /** Collects what is wrong with the input. */
  class Complaints
  {
  public:
    /**
     * Note that @p text is wrong at @p where ("file:line", or "" when there is no place). The same words about the same
     * place are told once: several readers may stumble over one mistake. Without a text it is a FollowUp. A text is cut
     * in its middle if it is long, and what is not printable is escaped.
     */
    void add(const std::string &where, const std::string &text);

    /** Note that @p text is doubtful at @p where: it is told, and not refused. The same words are told once. */
    void doubt(const std::string &where, const std::string &text);

    /** "file:line: what is doubtful", in the order in which it was found. */
    const std::vector<std::string> &
    doubts() const
    {
      return doubtful;
    }

    /** Add a complaint that has its place in front: what another collection has found. */
    void add_all(const std::vector<std::string> &complaints);

    /** Whether there are none that have words. */
    bool empty() const;

    /**
     * How often something was wrong so far; follow-ups count, too, and so does what has been told before: whoever sees
     * the count grow while an object is read knows that the object is faulty, whether it is the first one or a copy.
     */
    std::size_t count() const;

    /** By file, in the order in which files were first complained about, and by line. */
    std::vector<std::string> all() const;

    /** The file was included at @p place: complaints about it will say so. */
    void note_inclusion(const std::string &file, const std::string &place);

    /** Take over what @p other knows of inclusions. */
    void note_inclusions_of(const Complaints &other);

    /**
     * Throw an InputError with all complaints, if there are any; of very many the first ones, and how many there are. Those
     * about included files tell where these were included.
     */
    void throw_if_any() const;

  private:
    std::vector<std::string>        complaints; ///< in the order in which they were found
    std::unordered_set<std::string> known;
    std::size_t                     n_follow_ups = 0; ///< and complaints that are known
    std::vector<std::string>        doubtful;

    std::map<std::string, std::vector<std::string>> inclusions; ///< places, by file

    /** " (included at model.prm:30)", all the way; empty of a file that is not included. */
    std::string chain_of(const std::string &file, unsigned int depth = 0) const;
  };
} // namespace samara

#endif
