within HydraulicTestBench;
package Crane "Active heave compensation: vessel, drum, wire, payload"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p><code>IdealCompensation</code> gives the references that the test bench follows (Eq. 5.50, 5.51);
<code>HydraulicCompensation</code> has the pump and its closed circuit in the winch. Heights point upwards and count
from
where the lower end of the slack wire hangs at the start.</p>
<p><b>Source:</b> thesis Section 5.7, Appendix A; numbers in <code>Data.Crane</code>.</p>
</html>"));
end Crane;
