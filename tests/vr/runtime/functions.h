// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/vr/runtime/state.h"

// The functions of OpenXR, each after its own name; loader.cpp has the table of them. All throw Refusal.
namespace ps::scripted {

// instance.cpp
XrResult destroyInstance(Instance&, XrInstance);
XrResult getInstanceProperties(Instance&, XrInstance, XrInstanceProperties*);
XrResult pollEvent(Instance&, XrInstance, XrEventDataBuffer*);
XrResult resultToString(Instance&, XrInstance, XrResult, char*);
XrResult structureTypeToString(Instance&, XrInstance, XrStructureType, char*);
XrResult stringToPath(Instance&, XrInstance, const char*, XrPath*);
XrResult pathToString(Instance&, XrInstance, XrPath, uint32_t, uint32_t*, char*);

// system.cpp
XrResult getSystem(Instance&, XrInstance, const XrSystemGetInfo*, XrSystemId*);
XrResult getSystemProperties(Instance&, XrInstance, XrSystemId, XrSystemProperties*);
XrResult enumerateViewConfigurations(Instance&, XrInstance, XrSystemId, uint32_t, uint32_t*, XrViewConfigurationType*);
XrResult getViewConfigurationProperties(Instance&, XrInstance, XrSystemId, XrViewConfigurationType,
                                        XrViewConfigurationProperties*);
XrResult enumerateViewConfigurationViews(Instance&, XrInstance, XrSystemId, XrViewConfigurationType, uint32_t,
                                         uint32_t*, XrViewConfigurationView*);
XrResult enumerateEnvironmentBlendModes(Instance&, XrInstance, XrSystemId, XrViewConfigurationType, uint32_t, uint32_t*,
                                        XrEnvironmentBlendMode*);
XrResult getOpenGLGraphicsRequirements(Instance&, XrInstance, XrSystemId, XrGraphicsRequirementsOpenGLKHR*);
XrResult getVisibilityMask(Instance&, XrSession, XrViewConfigurationType, uint32_t, XrVisibilityMaskTypeKHR,
                           XrVisibilityMaskKHR*);
XrResult enumerateDisplayRefreshRates(Instance&, XrSession, uint32_t, uint32_t*, float*);
XrResult getDisplayRefreshRate(Instance&, XrSession, float*);
XrResult requestDisplayRefreshRate(Instance&, XrSession, float);

// session.cpp
XrResult createSession(Instance&, XrInstance, const XrSessionCreateInfo*, XrSession*);
XrResult destroySession(Instance&, XrSession);
XrResult beginSession(Instance&, XrSession, const XrSessionBeginInfo*);
XrResult endSession(Instance&, XrSession);
XrResult requestExitSession(Instance&, XrSession);

// frame.cpp
XrResult waitFrame(Instance&, XrSession, const XrFrameWaitInfo*, XrFrameState*);
XrResult beginFrame(Instance&, XrSession, const XrFrameBeginInfo*);
XrResult endFrame(Instance&, XrSession, const XrFrameEndInfo*);

// swapchain.cpp
XrResult enumerateSwapchainFormats(Instance&, XrSession, uint32_t, uint32_t*, int64_t*);
XrResult createSwapchain(Instance&, XrSession, const XrSwapchainCreateInfo*, XrSwapchain*);
XrResult destroySwapchain(Instance&, XrSwapchain);
XrResult enumerateSwapchainImages(Instance&, XrSwapchain, uint32_t, uint32_t*, XrSwapchainImageBaseHeader*);
XrResult acquireSwapchainImage(Instance&, XrSwapchain, const XrSwapchainImageAcquireInfo*, uint32_t*);
XrResult waitSwapchainImage(Instance&, XrSwapchain, const XrSwapchainImageWaitInfo*);
XrResult releaseSwapchainImage(Instance&, XrSwapchain, const XrSwapchainImageReleaseInfo*);

// space.cpp
XrResult enumerateReferenceSpaces(Instance&, XrSession, uint32_t, uint32_t*, XrReferenceSpaceType*);
XrResult createReferenceSpace(Instance&, XrSession, const XrReferenceSpaceCreateInfo*, XrSpace*);
XrResult getReferenceSpaceBoundsRect(Instance&, XrSession, XrReferenceSpaceType, XrExtent2Df*);
XrResult createActionSpace(Instance&, XrSession, const XrActionSpaceCreateInfo*, XrSpace*);
XrResult destroySpace(Instance&, XrSpace);
XrResult locateSpace(Instance&, XrSpace, XrSpace, XrTime, XrSpaceLocation*);
XrResult locateViews(Instance&, XrSession, const XrViewLocateInfo*, XrViewState*, uint32_t, uint32_t*, XrView*);

// handtracking.cpp
XrResult createHandTracker(Instance&, XrSession, const XrHandTrackerCreateInfoEXT*, XrHandTrackerEXT*);
XrResult destroyHandTracker(Instance&, XrHandTrackerEXT);
XrResult locateHandJoints(Instance&, XrHandTrackerEXT, const XrHandJointsLocateInfoEXT*, XrHandJointLocationsEXT*);

// action.cpp
XrResult createActionSet(Instance&, XrInstance, const XrActionSetCreateInfo*, XrActionSet*);
XrResult destroyActionSet(Instance&, XrActionSet);
XrResult createAction(Instance&, XrActionSet, const XrActionCreateInfo*, XrAction*);
XrResult destroyAction(Instance&, XrAction);

// binding.cpp
XrResult suggestInteractionProfileBindings(Instance&, XrInstance, const XrInteractionProfileSuggestedBinding*);
XrResult attachSessionActionSets(Instance&, XrSession, const XrSessionActionSetsAttachInfo*);
XrResult getCurrentInteractionProfile(Instance&, XrSession, XrPath, XrInteractionProfileState*);
XrResult enumerateBoundSourcesForAction(Instance&, XrSession, const XrBoundSourcesForActionEnumerateInfo*, uint32_t,
                                        uint32_t*, XrPath*);
XrResult getInputSourceLocalizedName(Instance&, XrSession, const XrInputSourceLocalizedNameGetInfo*, uint32_t,
                                     uint32_t*, char*);

// input.cpp
XrResult syncActions(Instance&, XrSession, const XrActionsSyncInfo*);
XrResult getActionStateBoolean(Instance&, XrSession, const XrActionStateGetInfo*, XrActionStateBoolean*);
XrResult getActionStateFloat(Instance&, XrSession, const XrActionStateGetInfo*, XrActionStateFloat*);
XrResult getActionStateVector2f(Instance&, XrSession, const XrActionStateGetInfo*, XrActionStateVector2f*);
XrResult getActionStatePose(Instance&, XrSession, const XrActionStateGetInfo*, XrActionStatePose*);

// haptic.cpp
XrResult applyHapticFeedback(Instance&, XrSession, const XrHapticActionInfo*, const XrHapticBaseHeader*);
XrResult stopHapticFeedback(Instance&, XrSession, const XrHapticActionInfo*);

}  // namespace ps::scripted
