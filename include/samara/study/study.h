#ifndef samara_study_study_h
#define samara_study_study_h

#include <samara/base/log.h>
#include <samara/base/parameters.h>
#include <samara/base/process.h>
#include <samara/input/input.h>
#include <samara/study/options.h>
#include <samara/study/study_quantity.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace samara
{
  /** What a member of a study has given. What is not known is nan. */
  struct StudyResult
  {
    bool        finished = false;
    std::string reason;                                             ///< why it fails, if it does
    double      cpu_seconds = std::nan(""), seconds = std::nan(""); ///< of its process; of the program's own work [s]
    double      unknowns = std::nan(""), steps = std::nan(""), iterations = std::nan(""), factorizations = std::nan("");
    double      value = std::nan(""), error = std::nan(""), rate = std::nan("");
  };



  /** One run of the program: a method with one set of values. */
  struct StudyMember
  {
    unsigned int method = 0;
    std::string  label;                 ///< "Step = 1e-3"
    std::string  value;                 ///< "1e-3"
    double       number = std::nan(""); ///< the same, if it is a number
    std::string  model;                 ///< file
    std::string  folder;                ///< of its results
    std::string  fingerprint;           ///< of all that its results depend on

    /** "Dynamic/Step = 1e-3", with the places in the study that name the entry and its value. */
    struct Override
    {
      std::string text, where, where_value;
    };
    std::vector<Override> overrides;

    StudyResult result;

    void add_overrides(const std::vector<std::string> &texts, const std::string &where);

    std::vector<std::string> override_texts() const;

    /** What rates are seen against: the value, or, if it is not a number, the unknowns. */
    double refinement() const;
  };



  /** A method or a level of modelling: a curve in the figures. */
  struct StudyMethod
  {
    std::string name, where;
    Parameters  parameters;

    // entries
    std::string overrides, vary, values, model;

    void add_parameters(Parameters &prm);
  };



  /**
   * A parameter study (doc/how_to/studies.md): runs of one model, or of several, with different entries, each in a
   * process of its own, compared by one quantity with a reference.
   *
   * Writes study.csv and .h5 with all members, study.txt with the tables of convergence, study_ladder.csv with what
   * each level costs; the results of members are in members/. A member that fails is reported with its reason and stops
   * nothing. Members whose results are there are not run again, unless something they depend on has changed.
   */
  class Study
  {
  public:
    /** Whether an input file is a study: <Analyses = study>. */
    static bool is_study(const Outline &outline);

    /** For the documentation of the entries. */
    Study() = default;

    /** Read one. @throws InputError with every complaint, those about its members among them. */
    Study(const std::string &name, InputFile file);

    void add_parameters(Parameters &prm);

    /**
     * Run what has not been run, @p n_jobs at a time, by @p program in processes of their own; then compare, and write.
     * @throws NotConverged if no member arrives, Interrupted
     */
    void run(const std::string &folder, unsigned int n_jobs, const Program &program, Log &log);

    std::string                               title;
    std::vector<std::unique_ptr<StudyMethod>> methods;
    std::vector<StudyMember>                  members; ///< in the order of the methods and their values

    /** The member that the others are compared with, or −1. */
    int reference_member = -1;

    // entries
    std::string model, quantity_text, norm = "final", error_kind = "relative", reference = "finest",
                                      reference_overrides, overrides, vary, values, cost = "time";
    double tolerance = 0, time_limit = 0;

  private:
    std::string   file, reference_file, reference_column;
    Parameters    root, settings;
    StudyQuantity quantity;
    bool          is_ladder = false;

    std::map<std::string, InputFile> files; ///< models of members by name, each read once

    // source/study.cc
    void read_methods(const Outline &outline, Complaints &complaints);

    // source/study_members.cc
    void                     make_members(const StudyMethod &method, unsigned int index, Complaints &complaints);
    void                     add_reference(Complaints &complaints);
    void                     name_folders();
    void                     check_members(Complaints &complaints);
    const InputFile         &model_of(const StudyMember &member);
    std::vector<std::string> faults_of(const StudyMember &member, const std::vector<std::string> &overrides);
    /** Of all that the model and the files it names say, with the overrides. */
    std::string fingerprint_of(const StudyMember &member);

    // source/study_run.cc
    void run_members(unsigned int n_jobs, const Program &program, Log &log);
    void evaluate();
    void compare(const std::vector<Series> &series);

    // source/study_report.cc
    void   report(const std::string &folder, Log &log) const;
    void   write_table(const std::string &folder) const;
    void   write_convergence(std::ostream &out, unsigned int method) const;
    void   write_ladder(const std::string &folder, std::ostream &out) const;
    double cost_of(const StudyResult &result) const;
  };
} // namespace samara

#endif
