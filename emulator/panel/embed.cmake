# cmake -DOUT=FILE.cpp -DFILES=a;b;... -P embed.cmake: the files' bytes as the table of assets().
set(types "html=text/html; charset=utf-8" "css=text/css; charset=utf-8" "js=text/javascript; charset=utf-8"
          "svg=image/svg+xml" "txt=text/plain; charset=utf-8")
set(arrays "")
set(rows "")
set(number 0)
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  get_filename_component(ending "${file}" LAST_EXT)
  string(SUBSTRING "${ending}" 1 -1 ending)
  set(type "")
  foreach(each IN LISTS types)
    if(each MATCHES "^${ending}=(.*)$")
      set(type "${CMAKE_MATCH_1}")
    endif()
  endforeach()
  if(type STREQUAL "")
    message(FATAL_ERROR "${file}: no type is known for .${ending}")
  endif()
  file(READ "${file}" bytes HEX)
  string(REGEX REPLACE "(................................................................)" "\\1\"\n    \"" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" bytes "${bytes}")
  file(SIZE "${file}" size)
  string(APPEND arrays "constexpr char file_${number}[] =\n    \"${bytes}\";\n")
  string(APPEND rows "    Asset{\"${name}\", \"${type}\", {file_${number}, ${size}}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE "${OUT}" "// Made by embed.cmake.
#include <array>

#include \"emulator/panel/assets.h\"

#pragma GCC diagnostic ignored \"-Woverlength-strings\"

namespace fauxboard::panel {
namespace {

${arrays}
constexpr std::array table{
${rows}};

}  // namespace

std::span<const Asset> assets() {
    return table;
}

}  // namespace fauxboard::panel
")
