#ifndef samara_output_vtu_h
#define samara_output_vtu_h

#include <samara/model/drawing.h>

#include <zlib.h>

#include <string>
#include <vector>

namespace samara
{
  /** zlib with one stream for many arrays: setting one up costs more than to compress a small array. */
  class Compressor
  {
  public:
    /** @throws std::runtime_error if there is no memory. */
    Compressor();
    ~Compressor();
    Compressor(const Compressor &)            = delete;
    Compressor &operator=(const Compressor &) = delete;

    /** The bytes of a complete zlib stream, until the next call. @throws std::runtime_error if there is no memory. */
    const std::vector<unsigned char> &operator()(const void *bytes, std::size_t n_bytes);

  private:
    z_stream                   stream{};
    std::vector<unsigned char> compressed;
  };



  /**
   * The content of a .vtu file of VTK (UnstructuredGrid, version 0.1) that shows a drawing: its points, lines and
   * quadrilaterals, displacement [m], velocity [m/s] and the number of the object at each point, and the fields of
   * points and cells with units and names of components, all as 32-bit numbers. Where an object does not have a field
   * it is not a number. Arrays are compressed by zlib and written as base64 between the tags, a form that all readers
   * understand.
   *
   * @throws std::runtime_error if zlib fails (no memory).
   */
  std::string vtu_of(const Drawing &drawing, Compressor &compressor);
} // namespace samara

#endif
