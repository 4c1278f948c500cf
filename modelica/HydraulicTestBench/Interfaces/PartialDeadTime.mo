within HydraulicTestBench.Interfaces;
partial model PartialDeadTime "Slot for the dead time of the inner loop"
  extends Icons.Slot;
  parameter Types.Duration tau "Dead time";
  RealInput s(unit="1") "Spool command of the card";
  RealOutput y(unit="1") "The same, tau later";
  annotation(Documentation(info="<html>
<p>The law is one equation that gives y from s and tau.</p>
<p><b>Source:</b> thesis Eq. 3.20, the factor e<sup>-&tau;s</sup>.</p>
</html>"));
end PartialDeadTime;
