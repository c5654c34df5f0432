#pragma once

#include <chrono>

#include <OgreFrameListener.h>
#include <OgreRoot.h>

namespace aeolian {

/// Times rviz' rendering, what its displays do in between not counted.
class FrameClock : public Ogre::FrameListener {
 public:
  void start() { Ogre::Root::getSingleton().addFrameListener(this); }
  void stop() { Ogre::Root::getSingleton().removeFrameListener(this); }

  std::size_t frames() const { return frames_; }
  double last_seconds() const { return last_seconds_; }

  bool frameStarted(const Ogre::FrameEvent& /*event*/) override {
    begin_ = Clock::now();
    return true;
  }
  bool frameEnded(const Ogre::FrameEvent& /*event*/) override {
    last_seconds_ = std::chrono::duration<double>(Clock::now() - begin_).count();
    ++frames_;
    return true;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_;
  std::size_t frames_ = 0;
  double last_seconds_ = 0;
};

}  // namespace aeolian
