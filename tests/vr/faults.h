// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QTest>

namespace ps {

/// What can go wrong of a headset and its software, as rows of a test: a script, and what the program says then; with
/// any OpenGL, below a layer as well.
inline void addFaultRows() {
  QTest::addColumn<QString>("script");
  QTest::addColumn<QString>("sentence");  // "" for an end that is no failure
  const auto row = [](const char* name, const QString& script, const char* sentence) {
    QTest::newRow(name) << script << sentence;
  };
  const auto fails = [&](const char* name, const char* call, const char* result, int frame, const char* sentence) {
    row(name, QString(R"({"events": [{"frame": %1, "fail": "%2", "result": "%3"}]})").arg(frame).arg(call, result),
        sentence);
  };
  fails("no headset", "xrGetSystem", "XR_ERROR_FORM_FACTOR_UNAVAILABLE", -1, "No headset is connected");
  fails("OpenGL refused", "xrCreateSession", "XR_ERROR_GRAPHICS_DEVICE_INVALID", -1, "does not take this program's");
  fails("pictures refused", "xrCreateSwapchain", "XR_ERROR_OUT_OF_MEMORY", -1, "has no memory left");
  fails("images refused", "xrEnumerateSwapchainImages", "XR_ERROR_RUNTIME_FAILURE", -1, "xrEnumerateSwapchainImages");
  fails("space refused", "xrCreateReferenceSpace", "XR_ERROR_RUNTIME_FAILURE", -1, "xrCreateReferenceSpace");
  fails("actions refused", "xrCreateAction", "XR_ERROR_RUNTIME_FAILURE", -1, "xrCreateAction");
  fails("attaching refused", "xrAttachSessionActionSets", "XR_ERROR_RUNTIME_FAILURE", -1, "xrAttachSessionActionSets");
  fails("begin refused", "xrBeginSession", "XR_ERROR_RUNTIME_FAILURE", -1, "xrBeginSession");
  fails("waiting fails", "xrWaitFrame", "XR_ERROR_SESSION_LOST", 9, "headset was lost");
  fails("begin of a frame fails", "xrBeginFrame", "XR_ERROR_RUNTIME_FAILURE", 9, "xrBeginFrame");
  fails("inputs fail", "xrSyncActions", "XR_ERROR_SESSION_LOST", 9, "headset was lost");
  fails("eyes fail", "xrLocateViews", "XR_ERROR_RUNTIME_FAILURE", 9, "xrLocateViews");
  fails("no image", "xrAcquireSwapchainImage", "XR_ERROR_RUNTIME_FAILURE", 9, "xrAcquireSwapchainImage");
  fails("no image back", "xrWaitSwapchainImage", "XR_TIMEOUT_EXPIRED", 9, "gave no picture back");
  fails("frame refused", "xrEndFrame", "XR_ERROR_RUNTIME_FAILURE", 9, "xrEndFrame: XR_ERROR_RUNTIME_FAILURE");
  fails("events fail", "xrPollEvent", "XR_ERROR_INSTANCE_LOST", 9, "has stopped");
  const auto event = [&](const char* name, const char* text, const char* sentence) {
    row(name, QString(R"({"events": [{"frame": 9, %1}]})").arg(text), sentence);
  };
  event("runtime dies", R"("dies": "XR_ERROR_INSTANCE_LOST")", "has stopped");
  event("runtime breaks", R"("dies": "XR_ERROR_RUNTIME_FAILURE")", "XR_ERROR_RUNTIME_FAILURE");
  event("session lost", R"("session_lost": true)", "headset was lost");
  event("loss is announced", R"("state": "LOSS_PENDING")", "about to be lost");
  event("runtime is about to stop", R"("instance_loss": true)", "about to stop");
  event("left in the headset's menu", R"("state": "EXITING")", "");
  row("leaving is not heard", R"({"events": [{"fail": "xrRequestExitSession", "result": "XR_SUCCESS"}]})",
      "did not answer");
  row("no OpenGL", R"({"extensions": ["XR_KHR_visibility_mask"]})", "does not show OpenGL's pictures");
  row("no sRGB", R"({"formats": ["RGBA8"]})", "shows no sRGB");
}

}  // namespace ps
