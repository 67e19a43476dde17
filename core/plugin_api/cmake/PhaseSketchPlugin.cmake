# SPDX-License-Identifier: MIT
#
# phasesketch_add_plugin(NAME KIND material|constraint|thermal|heat_source|brush METADATA FILE.json SOURCES FILE... [LIBS TARGET...])
#
# Makes the plugin NAME.so, from C++ sources and the metadata that Q_PLUGIN_METADATA names. List the header that holds
# Q_PLUGIN_METADATA among SOURCES: then an edited JSON file is compiled in at once. Keep the class in that header; moc
# reads it by itself. The metadata are checked here, because moc only warns of a broken file.
#
# Where it goes: the directory in PHASESKETCH_PLUGIN_OUTPUT_DIRECTORY, or else ${CMAKE_BINARY_DIR}/phasesketch-plugins;
# put that directory into the environment variable PHASESKETCH_PLUGIN_PATH and start phasesketch. `cmake --install`
# copies the plugin to lib/phasesketch/plugins under the prefix.
include_guard(GLOBAL)

# phasesketch_check_metadata(FILE KIND): stops with the file's name when a key is missing or the kind differs.
function(phasesketch_check_metadata file kind)
  file(READ "${file}" text)
  foreach(key id kind api version licence)
    string(JSON value ERROR_VARIABLE problem GET "${text}" ${key})
    if(problem)
      message(FATAL_ERROR "${file}: /${key}: ${problem}")
    elseif(value STREQUAL "")
      message(FATAL_ERROR "${file}: /${key}: must not be empty")
    endif()
    if(key STREQUAL "kind" AND NOT value STREQUAL kind)
      message(FATAL_ERROR "${file}: /kind: is \"${value}\", but phasesketch_add_plugin says KIND ${kind}")
    endif()
  endforeach()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
endfunction()

function(phasesketch_add_plugin name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "KIND;METADATA" "SOURCES;LIBS")
  set(kinds material constraint thermal heat_source brush) # here, not at file level: callers are in other directories
  if(NOT arg_KIND IN_LIST kinds)
    message(FATAL_ERROR "phasesketch_add_plugin(${name}): KIND must be one of ${kinds}")
  endif()
  if(NOT arg_SOURCES OR NOT arg_METADATA)
    message(FATAL_ERROR "phasesketch_add_plugin(${name}): SOURCES and METADATA are needed")
  endif()
  get_filename_component(metadata "${arg_METADATA}" ABSOLUTE)
  phasesketch_check_metadata("${metadata}" ${arg_KIND})

  add_library(${name} MODULE ${arg_SOURCES})
  set_target_properties(${name} PROPERTIES
    PREFIX "" AUTOMOC ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_compile_features(${name} PRIVATE cxx_std_20)
  target_compile_definitions(${name} PRIVATE QT_PLUGIN QT_NO_KEYWORDS)
  if(TARGET ps_plugin_api) # a plugin of PhaseSketch's own tree
    target_link_libraries(${name} PRIVATE ps_plugin_api ps_flags Qt6::Core ${arg_LIBS})
    set(PHASESKETCH_PLUGIN_OUTPUT_DIRECTORY ${PS_PLUGIN_BUILD_DIR})
  else()
    target_link_libraries(${name} PRIVATE PhaseSketch::plugin_api Qt6::Core ${arg_LIBS})
    if(NOT PHASESKETCH_PLUGIN_OUTPUT_DIRECTORY)
      set(PHASESKETCH_PLUGIN_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/phasesketch-plugins)
    endif()
  endif()
  set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${PHASESKETCH_PLUGIN_OUTPUT_DIRECTORY}")
  install(TARGETS ${name} LIBRARY DESTINATION lib/phasesketch/plugins)
endfunction()
