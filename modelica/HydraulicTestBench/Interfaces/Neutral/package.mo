within HydraulicTestBench.Interfaces;
package Neutral "What the base model puts into a slot: nothing"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>One class per slot whose physics the thesis does not have. Each adds exactly zero, or hands its signal on as it is,
without a state or an event.</p>
<p><b>Source:</b> thesis Eq. 3.1 to 3.20.</p>
</html>"));
end Neutral;
