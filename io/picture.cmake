# Pictures, charts and files of VTK, apart from the rest of io because of VTK: the search links none of it.
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)  # programs and tests of other folders link these through the picture library
find_package(VTK 9.1 REQUIRED COMPONENTS ChartsCore CommonColor CommonCore CommonDataModel IOImage IOXML ImagingCore RenderingContext2D
                                         RenderingContextOpenGL2 RenderingCore RenderingFreeType RenderingOpenGL2)
find_package(X11 REQUIRED)
find_package(OpenGL REQUIRED)

menger_layer(picture
  SOURCES chart.cpp chart_legend.cpp chart_panel.cpp chart_scale.cpp offscreen_display.cpp picture.cpp
  LINK menger::io
  PRIVATE_LINK ${VTK_LIBRARIES} X11::X11 OpenGL::GL)
vtk_module_autoinit(TARGETS menger_picture MODULES ${VTK_LIBRARIES})

menger_layer(vtk_file SOURCES vtk_file.cpp LINK menger::io PRIVATE_LINK VTK::CommonCore VTK::CommonDataModel VTK::IOXML)
