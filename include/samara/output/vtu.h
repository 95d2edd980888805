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
    std::vector<Drawing::Cell> cells;         ///< of the last drawing
    std::string                text_of_cells; ///< their arrays

    template <typename Number>
    void add_array(const std::string         &attributes,
                   const std::vector<Number> &numbers,
                   unsigned int               n_components,
                   std::string               &text);
    template <typename Value>
    void add_field(const std::string              &name,
                   const std::string              &unit,
                   const std::vector<std::string> &components,
                   std::size_t                     n,
                   const Value                    &value,
                   std::string                    &text);
    void add_cells(const Drawing &drawing, std::string &text);
    void add_point_data(const Drawing &drawing, std::string &text);
    void add_cell_data(const Drawing &drawing, std::string &text);
  };
} // namespace samara

#endif
