// SPDX-License-Identifier: GPL-3.0-or-later
// The page: the template with the run's data packed into it.
#include "mortise/report/page.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>

#include "mortise/core/errors.hpp"
#include "report/page_data.hpp"
#include "report/page_mesh.hpp"
#include "report/page_resource.hpp"

namespace mortise {
namespace {

std::string gzip(const std::string& text) {
  namespace io = boost::iostreams;
  std::string packed;
  {
    io::gzip_params params(6);
    params.mtime = 0;  // equal runs give equal pages
    io::filtering_ostream out;
    out.push(io::gzip_compressor(params));
    out.push(io::back_inserter(packed));
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
  }
  return packed;
}

std::string base64(const std::string& bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  // In pieces, whose size divides by 3: OpenSSL counts in int.
  constexpr std::size_t kPiece = 3 << 24;
  std::size_t written = 0;
  for (std::size_t from = 0; from < bytes.size(); from += kPiece) {
    const std::size_t count = std::min(kPiece, bytes.size() - from);
    written += static_cast<std::size_t>(EVP_EncodeBlock(
        reinterpret_cast<unsigned char*>(text.data() + written),
        reinterpret_cast<const unsigned char*>(bytes.data() + from), static_cast<int>(count)));
  }
  text.resize(written);
  return text;
}

std::string escape_html(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return escaped;
}

// The places lie in this order in the template.
std::string fill(std::string_view text, const std::string& title, const std::string& data) {
  constexpr std::string_view kTitle = "@title@";
  constexpr std::string_view kData = "@data@";
  const std::size_t at_title = text.find(kTitle);
  const std::size_t at_data = text.find(kData, at_title);
  std::string page;
  page.reserve(text.size() + title.size() + data.size());
  page.append(text.substr(0, at_title)).append(title);
  text.remove_prefix(at_title + kTitle.size());
  const std::size_t rest = at_data - at_title - kTitle.size();
  page.append(text.substr(0, rest)).append(data);
  page.append(text.substr(rest + kData.size()));
  return page;
}

// Bodies as the page carries them: parts with at most about so many triangles.
ReportBodies for_page(const ReportBodies& bodies, int most,
                      std::array<detail::PagePart, 2>& parts) {
  constexpr Eigen::Index kColoured = 16'000;  // triangles that colours need
  ReportBodies shown = bodies;
  ReportBody* const both[] = {&shown.fixed, &shown.moving};
  for (std::size_t b = 0; b < 2; ++b) {
    TriangleMesh& mesh = both[b]->mesh;
    if (mesh.size() == 0) continue;
    parts[b].triangles = mesh.size();
    detail::SimplifiedMesh made = detail::simplified(mesh, most);
    parts[b].deviation = made.deviation;
    mesh = std::move(made.mesh);
  }
  if (shown.fixed.is_mesh())
    shown.fixed.mesh = detail::cut_up(shown.fixed.mesh, std::min<Eigen::Index>(most, kColoured));
  return shown;
}

}  // namespace

bool report_page_available() noexcept { return !detail::page_template().empty(); }

std::string report_page(const Run& run, const ReportBodies& bodies, const PageOptions& options) {
  if (!report_page_available())
    throw InputError("report: this build has no page (it was configured with MORTISE_REPORT=OFF)");
  if (options.frequency_poses < 1)
    throw InputError("report: frequency_poses must be >= 1, got " +
                     std::to_string(options.frequency_poses));
  constexpr int kLeastTriangles = 100;
  if (options.part_triangles < kLeastTriangles)
    throw InputError("report: part_triangles must be >= 100, got " +
                     std::to_string(options.part_triangles));
  check_run(run, "report");
  std::array<detail::PagePart, 2> parts;
  const ReportBodies shown = for_page(bodies, options.part_triangles, parts);
  constexpr double kTouch = 5.0;  // angstrom, as the contacts that the page shows
  double cutoff = kTouch;
  if (shown.fixed.is_mesh()) {
    const Eigen::Matrix3Xd& v = shown.fixed.mesh.vertices;
    cutoff = 0.02 * (v.rowwise().maxCoeff() - v.rowwise().minCoeff()).norm();
  }
  const int counted =
      std::min<int>(options.frequency_poses, static_cast<int>(run.poses.poses.size()));
  const Eigen::VectorXd frequency =
      touch_frequency(run, shown, cutoff, options.frequency_poses, options.threads);
  return fill(
      detail::page_template(),
      escape_html(detail::body_name(run.fixed) + " + " + detail::body_name(run.moving) +
                  " - Mortise"),
      base64(gzip(detail::page_data(run, shown, parts, options.clusters, frequency, counted))));
}

}  // namespace mortise
