#ifndef samara_report_page_sources_h
#define samara_report_page_sources_h

#include <string>

namespace samara
{
  /** What contrib/report has, as it was when the program was built: page.html, page.css, page.min.js. @{ */
  std::string page_frame();
  std::string page_style();
  std::string page_script();
  /** @} */
} // namespace samara

#endif
