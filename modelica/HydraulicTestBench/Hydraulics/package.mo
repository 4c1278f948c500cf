within HydraulicTestBench;
package Hydraulics "Volumes, orifices, valves and pressure sources"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>Parts of hydraulic circuits, joined at ports of gauge pressure and volume flow.</p>
<p><b>Source:</b> thesis Section 3.2.1.</p>
</html>"));
end Hydraulics;
