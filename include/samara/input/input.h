#ifndef samara_input_input_h
#define samara_input_input_h

#include <samara/input/assembled_drawing.h>
#include <samara/input/catalogue.h>
#include <samara/input/subsystems.h>
#include <samara/model/system.h>

#include <algorithm>

namespace samara
{
  /** A file as it was read, once for all who want to know what it says, with what is wrong in it. */
  struct InputFile
  {
    explicit InputFile(const std::string &name)
      : outline(Outline::of_file(name, complaints))
    {}

    Complaints complaints;
    Outline    outline;
  };



  /** What an input file says: a model, and what is to be done with it. */
  class Input
  {
  public:
    /**
     * Read a file with overrides "Bodies/shaft/Degree = 4" from the command line.
     * @throws InputError with every complaint at once.
     */
    Input(const Catalogue &catalogue, const std::string &file, const std::vector<std::string> &overrides = {});

    Input(const Catalogue &catalogue, InputFile file, const std::vector<std::string> &overrides = {});

    /** How the bodies of a rough drawing have been moved; nothing where no joint wants it. The model is that of then.
     */
    std::shared_ptr<const AssembledDrawing> assembled;

    /** An empty one, for the documentation of its entries. */
    Input() = default;

    std::string title;
    Model       model;

    std::vector<std::unique_ptr<Analysis>> analyses;
    std::vector<std::string>               probes;
    std::vector<double>                    rotor_speeds;
    std::vector<std::string>               doubts; ///< "file:line: what may not be meant", for warnings
    bool                                   pictures        = true;
    bool                                   says_redundant  = false;       ///< an entry of earlier versions is set
    bool                                   report          = true;        ///< whether a page of the results is written
    bool                                   watch           = false;       ///< whether it is written again and again
    unsigned int                           report_pictures = 150;         ///< of a motion, in the page
    std::string                            report_fields   = "automatic"; ///< all of them, or only their sizes

    bool
    has_analysis(const std::string &kind) const
    {
      return std::find(analysis_names.begin(), analysis_names.end(), kind) != analysis_names.end();
    }

    /** Whether there are no bodies, and none of the analyses needs any. */
    bool
    is_without_bodies() const
    {
      return model.nodes.size() == 1 && !analyses.empty() &&
             std::none_of(analyses.begin(), analyses.end(), [](const auto &a) { return a->needs_bodies(); });
    }

    /** Make the linear solver and the number of threads that the file asks for those of this process. */
    void use_settings() const;

    /** The system; if it cannot be made, wrong probes are complained about, too. @throws InputError */
    std::unique_ptr<System> assemble();

    /** The probes, once the system is assembled. @throws InputError */
    std::vector<Probe> make_probes() const;

    /** "file:line" of an entry that stands outside of named objects; of the file's beginning if it was not given. */
    std::string
    where(const std::string &entry) const
    {
      return root.where(entry);
    }

    /** All values as they are used, in SI units, as a .prm file that says the same: without constants, copies,
     * includes. */
    void print(std::ostream &out) const;

    /** The same with the contents of the files that it names: what the model is, for checkpoints. */
    std::shared_ptr<const std::string> used() const;

    /** Declare the entries that stand outside of named objects; for reading and for the documentation. */
    void add_parameters(Parameters &prm, const Catalogue &catalogue);

  private:
    /** With what becomes of gaps: a drawing is read as it is to be assembled, and then once more. */
    Input(const Catalogue &catalogue, InputFile file, const std::vector<std::string> &overrides, Gaps gaps);

    AssemblySettings         assembly;
    Parameters               root;
    std::vector<std::string> analysis_names;
    std::vector<std::string> subsections; ///< of each item: "Bodies", ...
    std::string              redundant, linear_solver = "automatic";
    unsigned int             threads = 0;

    std::vector<const Outline *> outlines; ///< of each item, while it is read

    std::map<std::string, std::string> places_of_probes; ///< of those that subsystems ask for, by their paths

    void add_probes_of(const Subsystems &subsystems);
    void
    read_objects(const Group &group, const Subsystems::Scope &scope, Subsystems &subsystems, Complaints &complaints);
    void               read_object(const Group             &group,
                                   const Subsystems::Scope &scope,
                                   const Subsystems        &subsystems,
                                   const Outline           &object,
                                   Complaints              &complaints);
    void               assemble_drawing(const Catalogue &catalogue, const InputFile &file, Gaps gaps);
    void               initialize_objects();
    void               find_more_mistakes(Complaints &complaints);
    std::vector<Probe> find_probes(Complaints &complaints) const;
    void               read_analyses(const Catalogue  &catalogue,
                                     const Outline    &outline,
                                     const Quantities &quantities,
                                     Complaints       &complaints);
  };

  /** "static" -> "Static", the name of the subsection of an analysis. */
  std::string subsection_of_analysis(const std::string &kind);
} // namespace samara

#endif
