#include "tunica/drawing/page.hpp"

#include <gtest/gtest.h>

#include "tunica/drawing/plot.hpp"

namespace tunica::drawing {
namespace {

const std::string hostile = "<script>alert('1')</script> & \"2\"";
const std::string harmless = "&lt;script&gt;alert(&#39;1&#39;)&lt;/script&gt; &amp; &quot;2&quot;";

TEST(Page, TitlesAndCaptionsAreNoMarkup) {
  for (const auto& text : {page::escaped(hostile), page::begin(hostile), page::picture("data:,", hostile)}) {
    EXPECT_NE(text.find(harmless), std::string::npos) << text;
    EXPECT_EQ(text.find("<script"), std::string::npos) << text;
  }
  EXPECT_EQ(page::body(page::begin("</h1>" + hostile) + "inside" + page::end()), "inside");
}

TEST(Page, TextOfPlotsIsNoMarkup) {
  const auto svg = draw_plot({{.name = hostile, .x = {0, 1}, .y = {0, 1}}},
                             {.title = hostile, .x_label = hostile, .y_label = hostile});
  EXPECT_EQ(svg.find("<script"), std::string::npos) << svg;
  EXPECT_NE(svg.find(harmless), std::string::npos) << svg;
}

TEST(Page, MessagesShowCodeAsCode) {
  EXPECT_EQ(page::prose("take `elements: quadratic`, & <none> else"),
            "take <code>elements: quadratic</code>, &amp; &lt;none&gt; else");
  EXPECT_EQ(page::prose("one `alone"), "one <code>alone</code>");
}

TEST(Page, IsUtf8WhateverFilesAreCalled) {
  EXPECT_EQ(page::escaped("M\xFCller \xC3\xBC"), "M\xEF\xBF\xBDller \xC3\xBC");
}

}  // namespace
}  // namespace tunica::drawing
