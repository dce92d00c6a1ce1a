// Parts of pages with a beat in 3D and curves that answer.
#pragma once

#include <string>
#include <vector>

#include "tunica/viewer/beat.hpp"
#include "tunica/viewer/pack.hpp"

namespace tunica::viewer {

/// First characters of a page to its heading, with the style of the viewer and a policy that lets run nothing but the
/// scripts of this program and fetches nothing.
std::string begin_page(const std::string& title);
/// The viewer; end_page() gives it its beat.
std::string view();
/// How exact the view is, as a table: errors of modes and whole numbers, and of simplified surfaces.
std::string accuracy(const PackedBeat& beat);
/// A place in the page for plot number `index` of those that end_page() gets, with a drawing for readers without
/// scripts.
std::string plot(const std::vector<Plot>& plots, std::size_t index, const std::string& caption);
/// The numbers of the plots, the scripts, and the end of the page. `shown`: the beat of its view(), null without one.
/// All that is not read by people stands here, after it, so that a browser paints the page before it takes that in.
std::string end_page(const std::vector<Plot>& plots, const PackedBeat* shown);

}  // namespace tunica::viewer
