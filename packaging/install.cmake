# What `make install` and `make package` put where. Two components, which CPack makes two Debian packages of: twindeck, which an engineer
# needs, and twindeck-data, the studies of this repository. Below share/twindeck the files keep their places of the source tree, so that one
# Makefile and one rule for finding them (src/runner/shipped_files.hpp) serve both.
set(share share/twindeck)
get_property(executables GLOBAL PROPERTY twindeck_executables)
find_program(TWINDECK_PYTHON NAMES /usr/bin/python3 python3 REQUIRED)

# Manual pages out of the programs' own tables.
set(manuals ${CMAKE_BINARY_DIR}/man/twindeck.1.gz)
foreach(token ${executables})
  list(APPEND manuals ${CMAKE_BINARY_DIR}/man/${token}.1.gz)
endforeach()
file(GLOB generator CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/paper/twindeck_reference/*.py)
add_custom_command(OUTPUT ${manuals}
  COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${CMAKE_SOURCE_DIR}/paper PYTHONDONTWRITEBYTECODE=1
    ${TWINDECK_PYTHON} -m twindeck_reference.manual --bin ${CMAKE_BINARY_DIR}/bin --driver ${CMAKE_SOURCE_DIR}/packaging/twindeck
    --version ${PROJECT_VERSION} --out ${CMAKE_BINARY_DIR}/man ${executables}
  DEPENDS ${executables} ${generator} ${CMAKE_SOURCE_DIR}/packaging/twindeck
  COMMENT "manual pages" VERBATIM)
add_custom_target(manuals ALL DEPENDS ${manuals})

install(TARGETS ${executables} RUNTIME DESTINATION bin COMPONENT twindeck)
install(PROGRAMS packaging/twindeck DESTINATION bin COMPONENT twindeck)
install(FILES ${manuals} DESTINATION share/man/man1 COMPONENT twindeck)
install(FILES Makefile DESTINATION ${share} COMPONENT twindeck)
install(FILES workflows/names.mk workflows/steps.mk workflows/study_steps.mk DESTINATION ${share}/workflows COMPONENT twindeck)
install(PROGRAMS workflows/python.sh workflows/check_names.sh workflows/new.sh workflows/recorded_inputs.sh workflows/study_steps.sh workflows/why.sh DESTINATION ${share}/workflows COMPONENT twindeck)
install(DIRECTORY workflows/common workflows/template DESTINATION ${share}/workflows COMPONENT twindeck PATTERN __pycache__ EXCLUDE)
install(DIRECTORY data/template data/wind DESTINATION ${share}/data COMPONENT twindeck PATTERN __pycache__ EXCLUDE)
install(DIRECTORY paper DESTINATION ${share} COMPONENT twindeck PATTERN __pycache__ EXCLUDE)
# Debian's python3 looks into /usr/lib/python3/dist-packages; with another prefix PYTHONPATH names the folder.
install(DIRECTORY python/twindeck DESTINATION lib/python3/dist-packages COMPONENT twindeck PATTERN __pycache__ EXCLUDE)
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION share/doc/twindeck COMPONENT twindeck)
install(DIRECTORY docs DESTINATION share/doc/twindeck COMPONENT twindeck PATTERN reference.md EXCLUDE)
install(FILES packaging/copyright DESTINATION share/doc/twindeck COMPONENT twindeck)

# The studies: those with a study.toml and the scripts of one without; not the template and what all share, which are above.
file(GLOB studies CONFIGURE_DEPENDS LIST_DIRECTORIES true ${CMAKE_SOURCE_DIR}/workflows/*)
foreach(study ${studies})
  get_filename_component(name ${study} NAME)
  if(IS_DIRECTORY ${study} AND NOT name MATCHES "^(template|common|batch)$")
    install(DIRECTORY ${study} DESTINATION ${share}/workflows COMPONENT data PATTERN __pycache__ EXCLUDE)
  endif()
endforeach()
install(DIRECTORY data/ponte_del_mare DESTINATION ${share}/data COMPONENT data)
install(FILES data/SHA256SUMS DESTINATION ${share}/data COMPONENT data)
install(FILES tests/steps/diagnosis_score.py tests/steps/parameter_score.py DESTINATION ${share}/tests/steps COMPONENT data)  # scores the study's virtual campaign
install(FILES LICENSE DESTINATION share/doc/twindeck-data RENAME copyright COMPONENT data)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME twindeck)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The twindeck developers")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL twindeck data)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_TWINDECK_PACKAGE_NAME twindeck)
set(CPACK_COMPONENT_TWINDECK_DESCRIPTION "finite element models of structures: updated and diagnosed from vibration records
Ten programs from the model and the records to the diagnosis, the command twindeck
over them, a catalogue of causes, a template of a study, the report and the Python package.")
# Shared libraries are found by dpkg-shlibdeps. libblas is a choice of the system's; OpenBLAS is three to four times as fast as the reference.
set(CPACK_DEBIAN_TWINDECK_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_TWINDECK_PACKAGE_DEPENDS "libopenblas0-pthread, libjs-three, make, python3, python3-jinja2, python3-matplotlib, python3-pandas")
set(CPACK_DEBIAN_TWINDECK_PACKAGE_SUGGESTS "twindeck-data, calculix-ccx")
set(CPACK_DEBIAN_DATA_PACKAGE_NAME twindeck-data)
set(CPACK_DEBIAN_DATA_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_TWINDECK_PACKAGE_SUGGESTS "python3-openpyxl")
set(CPACK_DEBIAN_DATA_PACKAGE_DEPENDS "twindeck (>= ${PROJECT_VERSION}), python3-scipy")
set(CPACK_COMPONENT_DATA_DESCRIPTION "studies of twindeck: the Ponte del Mare and structures that others measured
Configurations, published tables and scripts. Measured records are not in it.")
include(CPack)
