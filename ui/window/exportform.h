// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/export/exportformat.h"
#include "ui/window/runform.h"

namespace ps {

/// Particles or surfaces of the recorded run, as files of other programs.
class ExportForm : public RunForm {
  Q_OBJECT
 public:
  explicit ExportForm(Session& session);

 protected:
  QString suggestedPlace() const override;
  QString choosePlace() override;
  QString summary() const override;
  QString fileNames() const override;
  void begin() override;

 private:
  const ExportFormat& format() const;
  QComboBox* m_format;
};

}  // namespace ps
