#ifndef samara_output_pictures_h
#define samara_output_pictures_h

#include <samara/output/vtu.h>

#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace samara
{
  /**
   * A series of pictures for ParaView:
   *
   *     FOLDER/NAME.pvd                   the series: open this one
   *     FOLDER/NAME.objects.txt           which number in the field `object` is which object of the model: a table with
   *                                       tabs, of number, name, subsection ("Joints") and kind ("revolute")
   *     FOLDER/pictures/NAME.0000.vtu     one file a picture
   *
   * The fields are displacement [m], velocity [m/s], object, and those of the drawing; see VtuWriter. The place before
   * the deformation is x − displacement.
   *
   * Every file is complete or absent, so that what a run left when it was killed can be opened. The series is rewritten
   * at the first picture, once a second, and by finish(). A picture is compressed and written beside the run; the next
   * one waits for it. What cannot be written is a CannotWrite with the name of the file, thrown by the next add() or by
   * finish().
   */
  class Pictures
  {
  public:
    /**
     * Makes the folder if there is none. A series begins afresh, and no file is written before the first picture; or,
     * with @p resume_after, an existing series goes on behind its pictures up to this time. If there is none it begins
     * afresh. If the .pvd file was not written by this class that is an InputError.
     */
    Pictures(const std::string           &folder,
             const std::string           &name,
             const std::optional<double> &resume_after = std::nullopt);

    ~Pictures();

    /** Write a picture. @p time is what ParaView orders the series by: seconds, a load factor, a phase. */
    void add(Drawing &&drawing, double time);

    /** Wait until all is written, the series too. The destructor does, too, but does not tell what went wrong. */
    void finish();

  private:
    void keep_series(double resume_after);
    void write(const Drawing &drawing, double time);
    void write_objects(const Drawing &drawing);
    void wait();
    void write_series();

    const std::string                           folder, name;
    std::vector<std::pair<double, std::string>> times_and_files;
    std::vector<std::string>                    written_objects;
    unsigned int                                n_in_series = 0; ///< that the file of the series names
    std::chrono::steady_clock::time_point       time_of_series;
    VtuWriter                                   vtu_of;
    std::future<void>                           being_written; ///< last, so that it ends before the others do
  };
} // namespace samara

#endif
