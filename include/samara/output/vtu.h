#ifndef samara_output_vtu_h
#define samara_output_vtu_h

#include <samara/model/drawing.h>
#include <samara/output/compressor.h>

#include <string>
#include <vector>

namespace samara
{
  /**
   * Contents of .vtu files of VTK (UnstructuredGrid, version 0.1) that show drawings: points, lines and
   * quadrilaterals, displacement [m], velocity [m/s] and the number of the object at each point, and the fields of
   * points and cells with units and names of components, all as 32-bit numbers. Where an object does not have a field
   * it is not a number. Arrays are compressed as zlib's streams and written as base64 between the tags, a form that
   * all readers understand.
   *
   * Pictures of a series mostly have the same cells: their text is kept from one to the next.
   */
  class VtuWriter
  {
  public:
    /** @throws std::runtime_error if zlib fails (no memory). */
    std::string operator()(const Drawing &drawing);

  private:
    Compressor                 compressor;
    std::vector<Drawing::Cell> cells;            ///< of the last drawing
    std::string                text_of_cells;    ///< their arrays
    std::size_t                size_of_last = 0; ///< picture, in bytes
    std::vector<unsigned int>  samples, times;   ///< of corners in a row that show the same one, and how many those are
    std::vector<float>         numbers;          ///< of the array that is being written

    void add_stream(const std::string                &attributes,
                    std::size_t                       n_bytes,
                    const std::vector<unsigned char> &compressed,
                    std::string                      &text);
    template <typename Number>
    void add_array(const std::string         &attributes,
                   const std::vector<Number> &numbers,
                   unsigned int               n_components,
                   std::string               &text);
    /** What value(sample, component) is at the samples of all corners. */
    template <typename Value>
    void add_field_of_samples(const Drawing                  &drawing,
                              const std::string              &name,
                              const std::string              &unit,
                              const std::vector<std::string> &components,
                              const Value                    &value,
                              std::string                    &text);
    void find_runs(const Drawing &drawing);
    void add_points(const Drawing &drawing, std::string &text);
    void add_cells(const Drawing &drawing, std::string &text);
    void add_point_data(const Drawing &drawing, std::string &text);
    void add_cell_data(const Drawing &drawing, std::string &text);
  };
} // namespace samara

#endif
