// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
#include "motex/project/texton_audit.h"

#include <gtest/gtest.h>

#include <variant>

#include "motex/core/error.h"
#include "motex/motion_texture/synthetic.h"

namespace motex {
namespace {

TEST(TextonAudit, ShowsEveryTextonOnceOverItsPages) {
  const MotionTexture& model = sample_model();
  std::size_t named = 0, places = 0;
  const int pages = num_audit_pages(model);
  ASSERT_GE(pages, 1);
  for (int page = 0; page < pages; ++page) {
    const Drawing drawing = texton_audit(model, page);
    EXPECT_GT(drawing.width, 100);
    EXPECT_GT(drawing.height, 50);
    for (const Shape& shape : drawing.shapes)
      if (const Text* text = std::get_if<Text>(&shape)) {
        named += text->text.starts_with("texton ") ? 1 : 0;
        places += text->text.find('@') != std::string::npos ? 1 : 0;
      }
  }
  EXPECT_EQ(named, model.textons.size());
  EXPECT_EQ(places, model.instances.size());
  EXPECT_THROW(texton_audit(model, pages), InvalidInput);
  EXPECT_THROW(texton_audit(model, -1), InvalidInput);
}

}  // namespace
}  // namespace motex
