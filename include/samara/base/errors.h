#ifndef samara_base_errors_h
#define samara_base_errors_h

#include <stdexcept>
#include <string>
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



  /** Collects what is wrong with the input in the order in which it was found. */
  class Complaints
  {
  public:
    /**
     * Note that @p text is wrong at @p where ("file:line", or "" when there is no place). The same words about the same
     * place count once: several readers may stumble over one mistake.
     */
    void add(const std::string &where, const std::string &text);

    bool empty() const;

    const std::vector<std::string> &all() const;

    /** Throw an InputError with all complaints, if there are any. */
    void throw_if_any() const;

  private:
    std::vector<std::string> complaints;
  };
} // namespace samara

#endif
