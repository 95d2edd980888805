// Arrays of pictures as streams of zlib. The reference is zlib: it must find in each stream what was put in, checksum
// and all, be it runs of equal values (written in fixed Huffman codes), noise (stored) or what the library itself
// deflates.

#include <samara/output/compressor.h>

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

using namespace samara;

namespace
{
  using Bytes = std::vector<unsigned char>;

  void
  expect_inflates_to(const Bytes &bytes, const Bytes &stream, const std::size_t size)
  {
    Bytes  found(bytes.size() + 1);
    uLongf length = found.size();
    ASSERT_EQ(uncompress(found.data(), &length, stream.data(), stream.size()), Z_OK)
      << bytes.size() << " bytes of values of " << size;
    found.resize(length);
    EXPECT_TRUE(found == bytes) << bytes.size() << " bytes of values of " << size;
  }

  void
  expect_comes_back(Compressor &compressor, const Bytes &bytes, const std::size_t size)
  {
    expect_inflates_to(bytes, compressor(bytes.data(), bytes.size() / size, size), size);
  }

  /** So many values of a size, each that often in a row, of bytes below @p letters. */
  Bytes
  runs(const std::size_t size, const std::size_t n_values, const std::size_t length, const unsigned int letters)
  {
    std::mt19937 random(size + 7 * n_values + 13 * length + letters);
    Bytes        bytes;
    for (std::size_t i = 0; i < n_values; ++i)
      if (i % length == 0)
        for (std::size_t j = 0; j < size; ++j)
          bytes.push_back(random() % letters);
      else
        bytes.insert(bytes.end(), bytes.end() - size, bytes.end());
    return bytes;
  }
} // namespace



TEST(Compressor, StreamsComeBack)
{
  Compressor compressor;
  for (const std::size_t size : {1, 2, 3, 4, 8, 12, 36, 64, 100})
    for (const std::size_t n : {0, 1, 2, 5, 60, 700})
      for (const std::size_t length : {1, 2, 3, 4, 12, 21, 22, 23, 300, 1000})
        for (const unsigned int letters : {1, 3, 256})
          expect_comes_back(compressor, runs(size, n, length, letters), size);
}



// All lengths of copies: 3 … 258, those of the codes with and without extra bits, and what is left over behind 258.
TEST(Compressor, AllLengthsOfRuns)
{
  Compressor compressor;
  for (std::size_t length = 4; length < 540; ++length)
    for (const std::size_t size : {1, 4})
      expect_comes_back(compressor, runs(size, 3 * length, length, 256), size);
}



// Large arrays: blocks of 65535 bytes and less for what does not shrink, checksums of long runs.
TEST(Compressor, LargeArrays)
{
  Compressor compressor;
  expect_comes_back(compressor, runs(4, 100000, 1, 256), 4);
  EXPECT_LT(compressor(runs(4, 100000, 1, 4).data(), 100000, 4).size(), 200000u); // two of eight bits say something
  expect_comes_back(compressor, runs(12, 200000, 200000, 256), 12);
  const Bytes tube = runs(12, 120000, 12, 256);
  expect_comes_back(compressor, tube, 12);
  EXPECT_LT(compressor(tube.data(), 120000, 12).size(), tube.size() / 9);
}



// Values with how often each comes: once, never, as often as outlines have corners, very often; also where neighbours
// are the same. The stream is that of the array in which all of them are written down.
TEST(Compressor, RepeatedValues)
{
  Compressor                      compressor;
  const std::vector<unsigned int> patterns[] = {{12, 12, 12}, {1, 2, 3, 0, 0, 4, 1}, {25}, {0}, {}, {66000, 1}};
  for (const std::size_t size : {1, 12, 64})
    for (const auto &times : patterns)
      for (const std::size_t length : {1, 2}) // of neighbours that are the same
        {
          const Bytes values = runs(size, times.size(), length, 256);
          Bytes       all;
          for (std::size_t i = 0; i < times.size(); ++i)
            for (unsigned int k = 0; k < times[i]; ++k)
              all.insert(all.end(), values.begin() + i * size, values.begin() + (i + 1) * size);
          expect_inflates_to(all, compressor.repeated(values.data(), times, size), size);
        }
}



TEST(Compressor, StoredAsTheyAre)
{
  Compressor compressor;
  for (const std::size_t n : {0, 1, 65535, 65536, 200000})
    {
      const Bytes bytes = runs(1, n, 1, 2);
      expect_inflates_to(bytes, compressor.as_they_are(bytes.data(), n), 1);
    }
}



TEST(Compressor, Base64)
{
  const std::string words     = "foobar",
                    encoded[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"}; // RFC 4648
  for (std::size_t n = 0; n <= words.size(); ++n)
    {
      std::string text = ">";
      add_base64(reinterpret_cast<const unsigned char *>(words.data()), n, text);
      EXPECT_EQ(text, ">" + encoded[n]);
    }
}
