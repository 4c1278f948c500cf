within HydraulicTestBench;
package Hydraulics "Volumes, hoses, orifices, valves, motors, sources and sensors"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>Parts of hydraulic circuits, joined at ports of gauge pressure and volume flow.</p>
<p><b>Source:</b> thesis Sections 3.2.1, 4.5, 5.2 and 5.3.</p>
</html>"));
end Hydraulics;
