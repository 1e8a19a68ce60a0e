// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// make_page OUT.html: the page that viewer_test.py plays. The clip's name is hostile on purpose.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "motex/core/files.h"
#include "motex/motion_io/bvh.h"
#include "motex/project/viewer_page.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: make_page OUT.html\n", stderr);
    return 2;
  }
  motex::Clip clip = motex::read_bvh(MOTEX_TEST_DATA "/mocap/quickstart/salsa_cmu61_10.bvh");
  clip.name = "salsa </script><script>throw 1</script> & <b>more</b>";
  std::vector<motex::TextonSpan> spans;
  for (motex::Index start = 0; start < clip.num_frames(); start += spans.back().length) {
    const int n = static_cast<int>(spans.size());
    const motex::Index length = std::min<motex::Index>(40 + 23 * n % 70, clip.num_frames() - start);
    spans.push_back({5 * n % 13, start, length, "salsa_cmu61_10 <frames> " + std::to_string(start)});
  }
  motex::write_file(argv[1], motex::viewer_page(clip, spans));
}
